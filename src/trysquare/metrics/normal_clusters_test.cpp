// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/normal_clusters.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <ostream>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace trysquare {
namespace {

using Normals = std::vector<Eigen::Vector3d>;
using Partition = std::set<std::set<std::size_t>>;

struct Kind {
  std::string name;
  NormalClusterSettings settings;
};

void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

NormalClusterSettings with_cut(NormalClusterSettings settings, double cut) {
  settings.cut = cut;
  return settings;
}

Partition partition_of(const std::vector<std::uint32_t>& labels) {
  std::map<std::uint32_t, std::set<std::size_t>> clusters;
  for (std::size_t i = 0; i < labels.size(); ++i) clusters[labels[i]].insert(i);
  Partition partition;
  for (const auto& [label, members] : clusters) partition.insert(members);
  return partition;
}

/// The definition, word for word, on all pairs of clusters; no formula is the code's.
class Definition {
 public:
  Definition(const Normals& normals, const NormalClusterSettings& settings) : settings_(settings) {
    std::vector<std::pair<std::vector<double>, std::size_t>> sorted;  // with the sign that counts in a tie
    for (std::size_t i = 0; i < normals.size(); ++i) {
      const Eigen::Vector3d& n = normals[i];
      const double first = n.x() != 0 ? n.x() : n.y() != 0 ? n.y() : n.z();
      const double sign = settings.sign_free && first < 0 ? -1 : 1;
      sorted.push_back({{sign * n.x(), sign * n.y(), sign * n.z()}, i});
    }
    std::sort(sorted.begin(), sorted.end());
    for (const auto& [coordinates, i] : sorted) {
      normals_.emplace_back(coordinates[0], coordinates[1], coordinates[2]);
      clusters_.push_back({normals_.size() - 1});
      input_.push_back(i);
    }
  }

  Partition partition() {
    std::vector<std::vector<double>> distances(clusters_.size(), std::vector<double>(clusters_.size()));
    for (std::size_t a = 0; a < clusters_.size(); ++a) refresh(distances, a);
    while (true) {
      double least = settings_.cut;
      std::size_t kept = 0;
      std::size_t gone = 0;
      for (std::size_t a = 0; a < clusters_.size(); ++a) {
        for (std::size_t b = a + 1; b < clusters_.size(); ++b) {
          if (clusters_[a].empty() || clusters_[b].empty() || distances[a][b] >= least) continue;
          least = distances[a][b];
          kept = a;
          gone = b;
        }
      }
      if (kept == gone) break;
      clusters_[kept].insert(clusters_[kept].end(), clusters_[gone].begin(), clusters_[gone].end());
      clusters_[gone].clear();
      refresh(distances, kept);
    }
    Partition result;
    for (const std::vector<std::size_t>& cluster : clusters_) {
      std::set<std::size_t> members;
      for (const std::size_t member : cluster) members.insert(input_[member]);
      if (!members.empty()) result.insert(members);
    }
    return result;
  }

 private:
  void refresh(std::vector<std::vector<double>>& distances, std::size_t a) const {
    for (std::size_t b = 0; b < clusters_.size(); ++b) {
      if (b == a || clusters_[b].empty()) continue;
      distances[a][b] = distances[b][a] = settings_.linkage == Linkage::kWard ? ward(a, b) : complete(a, b);
    }
  }

  double complete(std::size_t a, std::size_t b) const {
    double greatest = 0;
    for (const std::size_t i : clusters_[a]) {
      for (const std::size_t j : clusters_[b]) {
        const double apart = (normals_[i] - normals_[j]).norm();
        const double together = (normals_[i] + normals_[j]).norm();
        greatest = std::max(greatest, settings_.sign_free ? std::min(apart, together) : apart);
      }
    }
    return greatest;
  }

  /// Ward's own words: by how much the squared distances to the centroids grow when the two become one.
  double ward(std::size_t a, std::size_t b) const {
    std::vector<std::size_t> both = clusters_[a];
    both.insert(both.end(), clusters_[b].begin(), clusters_[b].end());
    return std::sqrt(std::max(0.0, 2 * (squares(both) - squares(clusters_[a]) - squares(clusters_[b]))));
  }

  double squares(const std::vector<std::size_t>& cluster) const {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const std::size_t i : cluster) mean += normals_[i] / static_cast<double>(cluster.size());
    double sum = 0;
    for (const std::size_t i : cluster) sum += (normals_[i] - mean).squaredNorm();
    return sum;
  }

  NormalClusterSettings settings_;
  Normals normals_;  ///< Sorted.
  std::vector<std::vector<std::size_t>> clusters_;
  std::vector<std::size_t> input_;
};

Normals random_normals(std::size_t count, double spread, unsigned seed) {
  std::mt19937_64 rng(seed);
  std::normal_distribution<double> normal(0, spread);
  Normals normals;
  for (std::size_t i = 0; i < count; ++i) {
    Eigen::Vector3d n = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(i % 3));
    n += Eigen::Vector3d(normal(rng), normal(rng), normal(rng));
    normals.push_back((i % 2 == 0 ? 1 : -1) * n.normalized());
  }
  return normals;
}

/// Of `axis` + step · (i, j): exact in binary, so that equal distances are equal to the last bit by every formula.
constexpr double kStep = 1.0 / 4096;

Normals lattice(int axis, int half_width) {
  Normals normals;
  for (int i = -half_width; i <= half_width; ++i) {
    for (int j = -half_width; j <= half_width; ++j) {
      Eigen::Vector3d n;
      n[axis] = 1;
      n[(axis + 1) % 3] = i * kStep;
      n[(axis + 2) % 3] = j * kStep;
      normals.push_back(n);
    }
  }
  return normals;
}

/// Corners, edges and faces of a cube, and the corners of an icosahedron; every third one twice.
Normals polyhedra() {
  Normals normals;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x != 0 || y != 0 || z != 0) normals.push_back(Eigen::Vector3d(x, y, z).normalized());
      }
    }
  }
  const double golden = (1 + std::sqrt(5.0)) / 2;
  for (int axis = 0; axis < 3; ++axis) {
    for (int corner = 0; corner < 4; ++corner) {
      Eigen::Vector3d n = Eigen::Vector3d::Zero();
      n[axis] = corner % 2 == 0 ? 1 : -1;
      n[(axis + 1) % 3] = corner / 2 == 0 ? golden : -golden;
      normals.push_back(n.normalized());
    }
  }
  for (std::size_t i = 0; i < 36; i += 3) normals.push_back(normals[i]);
  return normals;
}

std::vector<std::size_t> shuffled_indices(std::size_t count, unsigned seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937_64(seed));
  return order;
}

Normals picked(const Normals& normals, const std::vector<std::size_t>& order) {
  Normals result;
  for (const std::size_t i : order) result.push_back(normals[i]);
  return result;
}

/// The partition of normals[order[0]], normals[order[1]], ... in terms of `normals`.
Partition partition_of_reordered(const Normals& normals, const std::vector<std::size_t>& order,
                                 const NormalClusterSettings& settings) {
  Partition result;
  for (const std::set<std::size_t>& cluster : partition_of(cluster_normals(picked(normals, order), settings))) {
    std::set<std::size_t> members;
    for (const std::size_t i : cluster) members.insert(order[i]);
    result.insert(members);
  }
  return result;
}

class ClusterNormalsOf : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, ClusterNormalsOf,
                         testing::Values(Kind{"CompleteSignFree", {}}, Kind{"CompleteSigned", {.sign_free = false}},
                                         Kind{"Ward", {.linkage = Linkage::kWard, .sign_free = false}}),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(ClusterNormalsOf, MakesThePartitionOfTheDefinition) {
  for (const double spread : {0.02, 0.1, 1.0}) {
    for (const double cut : {0.1, 0.4, 1.3}) {
      for (unsigned seed = 0; seed < 4; ++seed) {
        const Normals normals = random_normals(90, spread, seed);
        const NormalClusterSettings settings = with_cut(GetParam().settings, cut);
        EXPECT_EQ(partition_of(cluster_normals(normals, settings)), Definition(normals, settings).partition())
            << spread << " " << cut << " " << seed;
      }
    }
  }
}

// The canonical sign has a boundary where x is 0: there neighbors have opposite signs.
TEST_P(ClusterNormalsOf, MakesThePartitionOfTheDefinitionAroundTheBoundaryOfSigns) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937_64 rng(seed);
    std::normal_distribution<double> across(0, 0.02);
    std::uniform_real_distribution<double> along(0, 1.5);
    Normals normals;
    for (int i = 0; i < 90; ++i) {
      const double angle = along(rng);
      normals.push_back(Eigen::Vector3d(across(rng), std::cos(angle), std::sin(angle)).normalized());
    }
    EXPECT_EQ(partition_of(cluster_normals(normals, GetParam().settings)),
              Definition(normals, GetParam().settings).partition());
  }
}

class ClusterNormalsExactly : public ClusterNormalsOf {};

INSTANTIATE_TEST_SUITE_P(Kinds, ClusterNormalsExactly,
                         testing::Values(Kind{"CompleteSignFree", {}}, Kind{"CompleteSigned", {.sign_free = false}}),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(ClusterNormalsExactly, MergesTheFirstOfPairsAtTheSameDistance) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double steps : {1.1, 2.1, 3.3, 5.0}) {
      Normals normals = lattice(axis, 3);
      normals.insert(normals.end(), normals.begin() + 10, normals.begin() + 20);
      for (std::size_t i = 0; i < normals.size(); i += 2) normals[i] *= -1;
      const NormalClusterSettings settings = with_cut(GetParam().settings, steps * kStep);
      EXPECT_EQ(partition_of(cluster_normals(normals, settings)), Definition(normals, settings).partition())
          << axis << " " << steps;
    }
  }
}

TEST_P(ClusterNormalsOf, DoesNotDependOnTheOrderOfTheNormals) {
  for (const Normals& normals : {lattice(0, 3), lattice(1, 3), polyhedra(), random_normals(300, 0.1, 5)}) {
    for (const double cut : {2.1 * kStep, 0.1, 0.7, 1.1}) {
      const NormalClusterSettings settings = with_cut(GetParam().settings, cut);
      const Partition expected = partition_of(cluster_normals(normals, settings));
      for (unsigned seed = 0; seed < 10; ++seed) {
        EXPECT_EQ(partition_of_reordered(normals, shuffled_indices(normals.size(), seed), settings), expected)
            << cut << " " << seed;
      }
    }
  }
}

TEST(ClusterNormals, DoesNotDependOnFreeSigns) {
  for (const Normals& normals : {lattice(0, 3), lattice(1, 3), polyhedra(), random_normals(300, 0.1, 6)}) {
    for (const double cut : {2.1 * kStep, 0.1, 0.7, 1.1}) {
      const std::vector<std::uint32_t> expected = cluster_normals(normals, {.cut = cut});
      std::mt19937_64 rng(7);
      for (int repetition = 0; repetition < 10; ++repetition) {
        Normals flipped = normals;
        for (Eigen::Vector3d& n : flipped) n *= rng() % 2 == 0 ? 1 : -1;
        EXPECT_EQ(cluster_normals(flipped, {.cut = cut}), expected) << cut;
      }
    }
  }
}

TEST(ClusterNormals, TakesOppositeNormalsForOne) {
  const Normals normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
  EXPECT_EQ(cluster_normals(normals), (std::vector<std::uint32_t>{0, 0, 1}));
}

TEST(ClusterNormals, TellsOppositeNormalsApartWhenSignsCount) {
  const Normals normals = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}};
  EXPECT_EQ(cluster_normals(normals, {.sign_free = false}), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(ClusterNormals, JoinsNeighborsAcrossTheBoundaryOfSigns) {
  const double x = 0.01;
  const double y = std::sqrt(1 - x * x);
  const Normals normals = {{x, y, 0}, {-x, y, 0}, {x, -y, 0}, {-x, -y, 0}, {0, 0, 1}};
  EXPECT_EQ(cluster_normals(normals), (std::vector<std::uint32_t>{0, 0, 0, 0, 1}));
}

TEST(ClusterNormals, TakesMinusZeroForZero) {
  const Normals normals = {{0.0, 0.0, 1}, {-0.0, 0.0, 1}, {0.0, -0.0, 1}, {-0.0, -0.0, 1}, {-0.0, 0.0, -1}};
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(cluster_normals(normals, {.cut = least}), (std::vector<std::uint32_t>{0, 0, 0, 0, 0}));
  EXPECT_EQ(cluster_normals(normals, {.cut = least, .sign_free = false}), (std::vector<std::uint32_t>{0, 0, 0, 0, 1}));
  const Normals ties = lattice(0, 3);
  std::mt19937_64 rng(9);
  for (int repetition = 0; repetition < 20; ++repetition) {
    Normals negative = ties;
    for (Eigen::Vector3d& n : negative) {
      for (double& coordinate : n) coordinate = coordinate == 0 && rng() % 2 == 0 ? -0.0 : coordinate;
    }
    const NormalClusterSettings settings{.cut = 2.1 * kStep, .sign_free = false};
    EXPECT_EQ(cluster_normals(negative, settings), cluster_normals(ties, settings));
  }
}

// Single linkage would join the chain; complete linkage may not: its ends are 0.12 apart.
TEST(ClusterNormals, KeepsTheEndsOfAChainApart) {
  Normals normals;
  for (const double angle : {0.0, 0.06, 0.12}) normals.emplace_back(std::cos(angle), std::sin(angle), 0);
  EXPECT_EQ(partition_of(cluster_normals(normals)).size(), 2u);
}

// √2 · √2 > 2 in floating point, so squares alone would merge some of these pairs.
TEST(ClusterNormals, MergesBelowTheCutAndNotAtIt) {
  for (int i = 0; i <= 3; ++i) {
    for (int j = 1; j <= 3; ++j) {
      const Normals normals = {{1, 0, 0}, {1, i * kStep, j * kStep}};
      const double distance = kStep * std::sqrt(i * i + j * j);
      EXPECT_EQ(partition_of(cluster_normals(normals, {.cut = distance})).size(), 2u) << i << " " << j;
      EXPECT_EQ(partition_of(cluster_normals(normals, {.cut = std::nextafter(distance, 1)})).size(), 1u)
          << i << " " << j;
    }
  }
}

// 2 · 50 · 50 / 100 = 50, and √50 · 0.05 > 0.1: the cut of Ward's linkage depends on the number of points.
TEST(ClusterNormals, CountsRepeatedNormalsInWardsLinkageOnly) {
  const double angle = 2 * std::asin(0.05 / 2);
  const Eigen::Vector3d n(1, 0, 0);
  const Eigen::Vector3d m(std::cos(angle), std::sin(angle), 0);
  NormalClusterSettings settings{.linkage = Linkage::kWard, .sign_free = false};
  EXPECT_EQ(partition_of(cluster_normals(Normals{n, m}, settings)).size(), 1u);
  Normals repeated(50, n);
  repeated.insert(repeated.end(), 50, m);
  EXPECT_EQ(partition_of(cluster_normals(repeated, settings)).size(), 2u);
  settings.linkage = Linkage::kComplete;
  EXPECT_EQ(partition_of(cluster_normals(repeated, settings)).size(), 1u);
}

// A regular tetrahedron: two merged corners are, by Ward, as far from the other ones as each was. In this one rounding
// makes that distance less, which no exact arithmetic could, and a chain of nearest neighbors runs into itself.
TEST(ClusterNormals, EndsWhenRoundingBreaksATieOfWards) {
  const Normals normals = {{0.63215640650410043, 0.71300474986267925, -0.30331914609711152},
                           {-0.70216925593867574, 0.40435587696416753, 0.58605004972192087},
                           {0.50309778733825539, -0.69507404417053842, 0.51358026587454109},
                           {-0.43308493790367997, -0.42228658265630825, -0.79631116949935021}};
  const NormalClusterSettings settings{.linkage = Linkage::kWard, .cut = 10, .sign_free = false};
  EXPECT_EQ(cluster_normals(normals, settings), (std::vector<std::uint32_t>{0, 0, 0, 0}));
}

TEST(ClusterNormals, EndsOnExactTies) {
  const Normals normals(200, Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(partition_of(cluster_normals(normals)).size(), 1u);
  EXPECT_TRUE(cluster_normals({}).empty());
}

TEST(ClusterNormals, LabelsInOrderOfFirstAppearance) {
  const Normals normals = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  EXPECT_EQ(cluster_normals(normals), (std::vector<std::uint32_t>{0, 1, 0, 2, 1}));
}

// All pairs would be 1.8e9 distances: 14 GB.
TEST_P(ClusterNormalsOf, TakesSixtyThousandNormals) {
  const Normals normals = random_normals(60'000, 0.02, 8);
  const std::vector<std::uint32_t> labels = cluster_normals(normals, GetParam().settings);
  std::map<std::uint32_t, Eigen::Vector3d> first;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Eigen::Vector3d& n = first.try_emplace(labels[i], normals[i]).first->second;
    const double apart = (n - normals[i]).norm();
    ASSERT_LT(GetParam().settings.sign_free ? std::min(apart, (n + normals[i]).norm()) : apart, 0.1);
  }
  EXPECT_GT(first.size(), 6u);
  EXPECT_LT(first.size(), 600u);
}

void expect_refused(const Normals& normals, const NormalClusterSettings& settings, const std::string& words) {
  try {
    cluster_normals(normals, settings);
    ADD_FAILURE() << "not refused: " << words;
  } catch (const InvalidArgument& error) {
    EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
  }
}

TEST(ClusterNormals, RefusesACutThatIsNotPositiveAndFinite) {
  for (const double cut : {0.0, -0.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    expect_refused({}, {.cut = cut}, "cut = ");
  }
}

TEST(ClusterNormals, RefusesWardsLinkageOfNormalsWithoutSigns) {
  expect_refused({}, {.linkage = Linkage::kWard}, "sign_free = true");
}

TEST(ClusterNormals, NamesTheNormalThatIsNone) {
  const double nan = std::nan("");
  expect_refused({{0, 0, 1}, {0, nan, 1}}, {}, "normals[1] is not finite");
  expect_refused({{0, 0, 1}, {0, 1, 0}, {0, 0, 0}}, {}, "normals[2] has the length 0,");
  expect_refused({{0, 0, 1 + 2e-6}}, {}, "normals[0] has the length 1.000002,");
  EXPECT_EQ(cluster_normals(Normals{{0, 0, 1 + 5e-7}}).size(), 1u);
}

}  // namespace
}  // namespace trysquare
