// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_triad.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/metrics_test_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace trysquare {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
using Normals = std::vector<Eigen::Vector3d>;

/// Normals with known modes, signs at random.
class Scene {
 public:
  explicit Scene(unsigned seed = 1) : rng_(seed) {}

  Eigen::Vector3d random_direction() { return Eigen::Vector3d(gauss_(rng_), gauss_(rng_), gauss_(rng_)).normalized(); }
  Scene& add(std::size_t count, const Eigen::Vector3d& direction, double scatter_rad = kDegree) {
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector3d error(gauss_(rng_), gauss_(rng_), gauss_(rng_));
      normals.push_back((gauss_(rng_) > 0 ? 1 : -1) * (direction + scatter_rad * error).normalized());
    }
    return *this;
  }
  Scene& add_clutter(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) normals.push_back(random_direction());
    return *this;
  }

  Normals normals;

 private:
  std::mt19937_64 rng_;
  std::normal_distribution<double> gauss_;
};

Eigen::Vector3d at(double azimuth_deg, double elevation_deg = 0) {
  const double azimuth = azimuth_deg * kDegree;
  const double elevation = elevation_deg * kDegree;
  return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation)};
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::min(1.0, std::abs(a.dot(b)))) / kDegree;
}

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

// Scatter of 2°, 20 normals: the mean's standard deviation is 0.45° per axis of its own; the other two share the error.
TEST(OrthogonalTriad, FindsThreeAxesInAnyFrame) {
  const Eigen::Matrix3d rotation = test::some_rotation();
  Scene scene;
  scene.add(400, rotation.col(2), 2 * kDegree).add(100, rotation.col(0), 2 * kDegree);
  scene.add(40, rotation.col(1), 2 * kDegree);
  const OrthogonalTriad triad = orthogonal_triad(scene.normals);
  ASSERT_EQ(triad.directions.size(), 3u);
  EXPECT_LT(angle_deg(triad.directions[0].axis, rotation.col(2)), 0.5);
  EXPECT_LT(angle_deg(triad.directions[1].axis, rotation.col(0)), 0.5);
  EXPECT_LT(angle_deg(triad.directions[2].axis, rotation.col(1)), 0.7);
}

TEST(OrthogonalTriad, HasOrthonormalAxesOfCanonicalSign) {
  Scene scene;
  scene.add(300, -at(10, 2)).add(200, at(101)).add(50, at(0, -89));
  const OrthogonalTriad triad = orthogonal_triad(scene.normals);
  ASSERT_EQ(triad.directions.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_NEAR(triad.directions[i].axis.dot(triad.directions[j].axis), i == j ? 1 : 0, 1e-14);
    }
    EXPECT_GT(triad.directions[i].axis.z(), 0);
    EXPECT_NEAR(triad.directions[i].offset_rad / kDegree,
                angle_deg(triad.directions[i].axis, triad.directions[i].mean_normal), 1e-6);
  }
}

TEST(OrthogonalTriad, LabelsNormalsAndCountsThem) {
  Scene scene;
  scene.add(30, at(0)).add(60, kUp).add(20, at(45, 45)).add(25, at(90));
  const OrthogonalTriad triad = orthogonal_triad(scene.normals);
  std::vector<std::uint8_t> expected(30, 1);
  expected.insert(expected.end(), 60, 0);
  expected.insert(expected.end(), 20, kNoDirection);
  expected.insert(expected.end(), 25, 2);
  EXPECT_EQ(triad.direction_of_normal, expected);
  EXPECT_EQ(triad.num_modes, 4u);
  ASSERT_EQ(triad.directions.size(), 3u);
  EXPECT_EQ(triad.directions[0].num_normals, 60u);
  EXPECT_EQ(triad.directions[1].support, 30);
  EXPECT_EQ(triad.directions[2].background, 0);
}

TEST(OrthogonalTriad, DoesNotDependOnOrderAndSigns) {
  Scene scene;
  scene.add(300, kUp).add(100, at(0)).add(100, at(90)).add(100, at(30)).add(100, at(120)).add_clutter(300);
  const OrthogonalTriad before = orthogonal_triad(scene.normals);
  std::vector<std::size_t> order(scene.normals.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  Normals shuffled;
  for (const std::size_t i : order) shuffled.push_back(i % 2 == 0 ? scene.normals[i] : -scene.normals[i]);
  const OrthogonalTriad after = orthogonal_triad(shuffled);
  ASSERT_EQ(before.directions.size(), 3u);
  ASSERT_EQ(after.directions.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(before.directions[k].axis, after.directions[k].axis);
    EXPECT_EQ(before.directions[k].support, after.directions[k].support);
  }
  for (std::size_t i = 0; i < order.size(); ++i)
    EXPECT_EQ(after.direction_of_normal[i], before.direction_of_normal[order[i]]);
}

TEST(OrthogonalTriad, OfAFloorIsOneDirection) {
  const OrthogonalTriad triad = orthogonal_triad(Scene().add(500, kUp, 2 * kDegree).normals);
  ASSERT_EQ(triad.directions.size(), 1u);
  EXPECT_LT(angle_deg(triad.directions[0].axis, kUp), 0.5);
  EXPECT_EQ(triad.directions[0].offset_rad, 0);
}

TEST(OrthogonalTriad, OfACorridorIsTwoDirections) {
  const OrthogonalTriad triad = orthogonal_triad(Scene().add(500, kUp).add(300, at(20)).add_clutter(50).normals);
  ASSERT_EQ(triad.directions.size(), 2u);
  EXPECT_LT(angle_deg(triad.directions[0].axis, kUp), 0.5);
  EXPECT_LT(angle_deg(triad.directions[1].axis, at(20)), 0.5);
  EXPECT_LT(std::abs(triad.directions[0].axis.dot(triad.directions[1].axis)), 1e-14);
}

/// No two closer to a right angle than `at_least_deg`.
Normals oblique_directions(Scene& scene, std::size_t count, double at_least_deg) {
  Normals directions;
  while (directions.size() < count) {
    const Eigen::Vector3d candidate = scene.random_direction();
    if (std::all_of(directions.begin(), directions.end(), [&](const Eigen::Vector3d& other) {
          const double angle = angle_deg(candidate, other);
          return angle > 25 && angle < 90 - at_least_deg;
        })) {
      directions.push_back(candidate);
    }
  }
  return directions;
}

TEST(OrthogonalTriad, OfObliquePlanesIsTheStrongest) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    Scene scene(seed);
    const Normals planes = oblique_directions(scene, 4, 10);
    for (std::size_t i = 0; i < planes.size(); ++i) scene.add(100 - 10 * i, planes[i]);
    const OrthogonalTriad triad = orthogonal_triad(scene.normals);
    ASSERT_EQ(triad.directions.size(), 1u) << seed;
    EXPECT_LT(angle_deg(triad.directions[0].axis, planes[0]), 0.5) << seed;
    EXPECT_EQ(triad.num_modes, 4u) << seed;
  }
}

// Random planes are now and then at right angles. The promise is the expected number: 0.02 a scene, and 8 of 400 scenes
// in the mean; 20 would be seen once in 10⁴.
TEST(OrthogonalTriad, OfRandomPlanesIsNoTriadMoreOftenThanPromised) {
  int num_triads = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    Scene scene(seed);
    for (std::size_t i = 0; i < 8; ++i) scene.add(40 - i, scene.random_direction());
    num_triads += orthogonal_triad(scene.normals).directions.size() == 3;
  }
  EXPECT_LT(num_triads, 20);
}

TEST(OrthogonalTriad, OfIsotropicClutterIsNothing) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    const OrthogonalTriad triad = orthogonal_triad(Scene(seed).add_clutter(3000).normals);
    EXPECT_TRUE(triad.directions.empty()) << seed;
    EXPECT_EQ(triad.direction_of_normal.front(), kNoDirection);
  }
}

// 1500 isotropic normals put 23 into every cone of 10°, nearly as many as the third direction has.
TEST(OrthogonalTriad, IsFoundInClutter) {
  Scene scene;
  scene.add(500, kUp).add(120, at(40)).add(40, at(130)).add_clutter(1500);
  const OrthogonalTriad triad = orthogonal_triad(scene.normals);
  ASSERT_EQ(triad.directions.size(), 3u);
  EXPECT_LT(angle_deg(triad.directions[2].axis, at(130)), 0.7);
  EXPECT_NEAR(triad.directions[0].background, 1500 * (1 - std::cos(0.175)), 10);
}

TEST(OrthogonalTriad, DoesNotStarveTheThirdDirection) {
  Scene scene;  // the diagonal wall has more normals than the other two together
  scene.add(1000, kUp).add(200, at(0)).add(90, at(30)).add(90, at(120));
  const OrthogonalTriad triad = orthogonal_triad(scene.normals);
  ASSERT_EQ(triad.directions.size(), 3u);
  EXPECT_LT(angle_deg(triad.directions[1].axis, at(30)) * angle_deg(triad.directions[1].axis, at(120)), 50);
}

// A gutter at 8°: it would pull the mean of all within the tolerance by 8° · 60 / 360 = 1.3°.
TEST(OrthogonalTriad, IsNotPulledByASurfaceBeside) {
  const OrthogonalTriad triad = orthogonal_triad(Scene().add(300, kUp).add(60, at(0, 82)).normals);
  ASSERT_EQ(triad.directions.size(), 1u);
  EXPECT_LT(angle_deg(triad.directions[0].axis, kUp), 0.5);
}

TEST(OrthogonalTriad, DoesNotTakeAnObliqueWall) {
  const OrthogonalTriad triad = orthogonal_triad(Scene().add(500, kUp).add(120, at(0)).add(100, at(80)).normals);
  ASSERT_EQ(triad.directions.size(), 2u);
  EXPECT_LT(angle_deg(triad.directions[1].axis, at(0)), 0.5);
}

// A depth camera that scatters normals by 5° bends walls by as much.
TEST(OrthogonalTriad, ForgivesNoisySensorsMore) {
  const auto num_directions = [](double scatter_rad) {
    Scene scene;
    scene.add(500, kUp, scatter_rad).add(400, at(0), scatter_rad).add(400, at(82), scatter_rad);
    return orthogonal_triad(scene.normals).directions.size();
  };
  EXPECT_EQ(num_directions(0.5 * kDegree), 2u);
  EXPECT_EQ(num_directions(4 * kDegree), 3u);
}

TEST(OrthogonalTriad, NeedsAMinimumOfSupport) {
  const auto num_directions = [](std::size_t third) {
    return orthogonal_triad(Scene().add(100, kUp).add(50, at(0)).add(third, at(90)).normals).directions.size();
  };
  EXPECT_EQ(num_directions(11), 2u);
  EXPECT_EQ(num_directions(12), 3u);
}

// Nine normals in the ring around it are a background of 9 · 0.3366 = 3.03 in the cone.
TEST(OrthogonalTriad, NeedsItsSupportAboveTheBackground) {
  const auto num_directions = [](std::size_t third) {
    Scene scene;
    scene.add(100, kUp).add(50, at(0)).add(third, at(90));
    for (int i = 0; i < 9; ++i) {
      const Eigen::Vector3d sideways = std::cos(40 * kDegree * i) * at(0) + std::sin(40 * kDegree * i) * kUp;
      scene.add(1, std::cos(15 * kDegree) * at(90) + std::sin(15 * kDegree) * sideways, 0);
    }
    return orthogonal_triad(scene.normals).directions.size();
  };
  EXPECT_EQ(num_directions(14), 2u);
  EXPECT_EQ(num_directions(16), 3u);
}

// A hill of 20° has 1.3 times as many normals at its top as around it: significant among 10,000, but no direction.
TEST(OrthogonalTriad, OfACurvedSurfaceIsNothing) {
  EXPECT_TRUE(orthogonal_triad(Scene().add(10'000, kUp, 20 * kDegree).normals).directions.empty());
}

TEST(OrthogonalTriad, CountsWeights) {
  Scene scene;
  scene.add(100, kUp).add(50, at(0)).add(6, at(90));
  std::vector<double> weights(156, 1);
  EXPECT_EQ(orthogonal_triad(scene.normals, {}, weights).directions.size(), 2u);
  std::fill(weights.begin() + 150, weights.end(), 20.0);
  const OrthogonalTriad triad = orthogonal_triad(scene.normals, {}, weights);
  ASSERT_EQ(triad.directions.size(), 3u);
  EXPECT_LT(angle_deg(triad.directions[0].axis, at(90)), 1);
  EXPECT_EQ(triad.directions[0].support, 120);
  EXPECT_EQ(triad.directions[0].num_normals, 6u);
}

// Against the frequency among random axes: 0.0051 ± 0.00016 for s = 0.2.
TEST(OrthogonalTriad, SaysHowOftenChanceGivesOneAsSquare) {
  constexpr double kCosine = 0.2;
  Scene scene;
  int num_square = 0;
  for (int trial = 0; trial < 200'000; ++trial) {
    const Eigen::Vector3d a = scene.random_direction();
    const Eigen::Vector3d b = scene.random_direction();
    const Eigen::Vector3d c = scene.random_direction();
    num_square += std::max({std::abs(a.dot(b)), std::abs(a.dot(c)), std::abs(b.dot(c))}) < kCosine;
  }
  scene.add(30, kUp, 0).add(30, at(0), 0).add(30, at(88), 0);
  const double largest_cosine = std::cos(88 * kDegree);
  const OrthogonalTriad triad = orthogonal_triad(scene.normals);
  ASSERT_EQ(triad.directions.size(), 3u);
  EXPECT_NEAR(triad.chance / std::pow(largest_cosine, 3), num_square / 200'000.0 / std::pow(kCosine, 3), 0.08);
}

TEST(OrthogonalTriad, DoesNotTrustAWeakDirectionAmongManyAsWeak) {
  const auto num_directions = [](std::size_t num_others) {
    Scene scene;
    scene.add(300, kUp).add(100, at(0)).add(20, at(87));
    for (std::size_t i = 0; i < num_others; ++i)
      scene.add(30, at(static_cast<double>(i) * 50 + 10, 28 + static_cast<double>(i % 2) * 25));
    return orthogonal_triad(scene.normals).directions.size();
  };
  EXPECT_EQ(num_directions(0), 3u);
  EXPECT_EQ(num_directions(12), 2u);
}

// Two planes at 88° are a pair; but among six planes chance gives half a pair like that: C(6, 2) · cos 88° = 0.52.
TEST(OrthogonalTriad, DoesNotTrustAPairAmongManyPlanes) {
  const auto num_directions = [](int num_others) {
    Scene scene;
    scene.add(100, kUp).add(30, at(20, 2));
    for (int i = 0; i < num_others; ++i) scene.add(60, at(72 * i, 55));  // at 39° or 66° to each other
    return orthogonal_triad(scene.normals).directions.size();
  };
  EXPECT_EQ(num_directions(0), 2u);
  EXPECT_EQ(num_directions(4), 1u);
}

TEST(OrthogonalTriad, OfNothingIsNothing) {
  EXPECT_TRUE(orthogonal_triad({}).directions.empty());
  EXPECT_TRUE(orthogonal_triad(Normals{kUp}).directions.empty());
}

TEST(OrthogonalTriadArguments, AreCheckedWithNameValueAndRange) {
  try {
    orthogonal_triad({}, {.tolerance_rad = 0.5});
    FAIL();
  } catch (const InvalidArgument& error) {
    EXPECT_STREQ(error.what(), "orthogonal triad: tolerance_rad = 0.5 is out of range: it must be in (0, π/8]");
  }
  EXPECT_THROW(orthogonal_triad({}, {.max_offset_rad = 0}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad({}, {.min_support = 0}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad({}, {.min_contrast = 1}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad({}, {.min_significance = 0}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad({}, {.max_chance_of_pair = 0}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad({}, {.max_chance_of_triad = 0}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad(Normals{{0, 0, 2}}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad(Normals{kUp}, {}, std::vector<double>{1, 1}), InvalidArgument);
  EXPECT_THROW(orthogonal_triad(Normals{kUp}, {}, std::vector<double>{-1}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
