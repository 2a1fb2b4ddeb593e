// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/orthogonal_triad.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/internal/canonical_sign.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace trysquare {
namespace {

using Directions = std::vector<TriadDirection>;

constexpr std::size_t kMaxSeeds = 1500;  ///< Normals whose density is looked at; bounds the time.
constexpr std::size_t kMaxClimbs = 64;   ///< Climbs from a seed to its mode; likewise.
constexpr int kMaxStepsOfClimb = 20;
constexpr double kSettledRad = 1e-7;

void require(bool in_range, const char* name, double value, const char* range) {
  if (!in_range)
    throw InvalidArgument(fmt::format("orthogonal triad: {} = {} is out of range: it must be {}", name, value, range));
}

bool is_positive(double value) { return value > 0 && value < std::numeric_limits<double>::infinity(); }

void require_valid(PointsView normals, std::span<const double> weights) {
  if (!weights.empty() && weights.size() != normals.size())
    throw InvalidArgument(fmt::format("orthogonal triad: {} normals, but {} weights: one is needed for each, or none",
                                      normals.size(), weights.size()));
  for (const Eigen::Vector3d& normal : normals)
    require(std::abs(normal.norm() - 1) < 1e-6, "length of a normal", normal.norm(), "1 within 1e-6");
  for (const double weight : weights) require(is_positive(weight), "weight", weight, "positive and finite");
}

struct WeightedNormal {
  Eigen::Vector3d normal;
  double weight;

  auto key() const { return std::tuple(normal.x(), normal.y(), normal.z(), weight); }
};
using Normals = std::vector<WeightedNormal>;

/// Signs and order are taken away, so that neither can decide anything, not even how a sum is rounded.
Normals sorted_normals(PointsView normals, std::span<const double> weights) {
  Normals sorted;
  sorted.reserve(normals.size());
  for (std::size_t i = 0; i < normals.size(); ++i) {
    sorted.push_back({with_canonical_sign(normals[i]), weights.empty() ? 1.0 : weights[i]});
  }
  std::sort(sorted.begin(), sorted.end(),
            [](const WeightedNormal& a, const WeightedNormal& b) { return a.key() < b.key(); });
  return sorted;
}

double cosine(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return std::abs(a.dot(b)); }

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), cosine(a, b));
}

bool is_near_any(const Eigen::Vector3d& normal, const std::vector<Eigen::Vector3d>& others, double cos_tolerance) {
  return std::any_of(others.begin(), others.end(),
                     [&](const Eigen::Vector3d& other) { return cosine(other, normal) > cos_tolerance; });
}

struct Seed {
  double density;  ///< Weight within the tolerance.
  Eigen::Vector3d normal;
};

/// Densest first; equal ones keep the order of the sorted normals.
std::vector<Seed> seeds_of_modes(const Normals& normals, const OrthogonalTriadSettings& settings) {
  const double cos_tolerance = std::cos(settings.tolerance_rad);
  const std::size_t stride = normals.size() / kMaxSeeds + 1;
  std::vector<Seed> seeds;
  for (std::size_t i = 0; i < normals.size(); i += stride) {
    Seed seed{0, normals[i].normal};
    for (const WeightedNormal& other : normals) {
      if (cosine(other.normal, seed.normal) > cos_tolerance) seed.density += other.weight;
    }
    if (seed.density >= settings.min_support) seeds.push_back(seed);
  }
  std::stable_sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.density > b.density; });
  return seeds;
}

/// Mean shift: again and again the mean of the normals within the tolerance, each by Tukey's biweight of its angle.
Eigen::Vector3d mode_near(Eigen::Vector3d mode, const Normals& normals, double tolerance_rad) {
  const double sin_tolerance = std::sin(tolerance_rad);
  for (int step = 0; step < kMaxStepsOfClimb; ++step) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [normal, weight] : normals) {
      const double along = normal.dot(mode);
      const double root = 1 - (1 - along * along) / (sin_tolerance * sin_tolerance);
      if (root > 0) sum += std::copysign(root * root * weight, along) * normal;
    }
    const double moved_rad = angle_between(sum.normalized(), mode);
    mode = sum.normalized();
    if (moved_rad < kSettledRad) break;
  }
  return with_canonical_sign(mode);
}

TriadDirection direction_around(const Eigen::Vector3d& mode, const Normals& normals, double tolerance_rad) {
  const double cos_tolerance = std::cos(tolerance_rad);
  const double cos_outer = std::cos(2 * tolerance_rad);
  TriadDirection direction{.axis = mode, .mean_normal = mode};
  double weight_of_ring = 0;
  double sum_of_squared_sines = 0;
  for (const auto& [normal, weight] : normals) {
    const double along = cosine(normal, mode);
    if (along > cos_tolerance) {
      ++direction.num_normals;
      direction.support += weight;
      sum_of_squared_sines += weight * (1 - along * along);
    } else if (along > cos_outer) {
      weight_of_ring += weight;
    }
  }
  direction.background = weight_of_ring * (1 - cos_tolerance) / (cos_tolerance - cos_outer);  // by area on the sphere
  if (direction.support > 0)
    direction.spread_rad = std::asin(std::sqrt(std::max(0.0, sum_of_squared_sines / direction.support)));
  return direction;
}

bool stands_out(const TriadDirection& mode, const OrthogonalTriadSettings& settings) {
  const double excess = mode.support - mode.background;
  return excess >= settings.min_support && mode.support >= settings.min_contrast * mode.background &&
         excess >= settings.min_significance * std::sqrt(mode.background);
}

/// Strongest first.
Directions find_modes(const Normals& normals, const OrthogonalTriadSettings& settings) {
  const double cos_tolerance = std::cos(settings.tolerance_rad);
  std::vector<Eigen::Vector3d> explored;  // where climbs began and ended
  std::vector<Eigen::Vector3d> peaks;
  Directions modes;
  for (const Seed& seed : seeds_of_modes(normals, settings)) {
    if (is_near_any(seed.normal, explored, cos_tolerance)) continue;
    const Eigen::Vector3d peak = mode_near(seed.normal, normals, settings.tolerance_rad);
    const bool is_known = is_near_any(peak, peaks, cos_tolerance);
    explored.insert(explored.end(), {seed.normal, peak});
    if (explored.size() >= 2 * kMaxClimbs) break;
    if (is_known) continue;
    peaks.push_back(peak);
    const TriadDirection mode = direction_around(peak, normals, settings.tolerance_rad);
    if (stands_out(mode, settings)) modes.push_back(mode);
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const TriadDirection& a, const TriadDirection& b) { return a.support > b.support; });
  return modes;
}

/// Small floors and walls count: a direction of 16 times the support weighs 4 times as much.
double weight_of(const TriadDirection& direction) { return std::sqrt(direction.support - direction.background); }

double score_of(const Directions& directions) {
  double sum = 0;
  for (const TriadDirection& direction : directions) sum += weight_of(direction);
  return sum;
}

/// The orthonormal axes nearest to the mean normals (orthogonal Procrustes). They may be a mirrored frame: axes have no
/// sign.
void make_square(Directions& directions) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> means(3, static_cast<Eigen::Index>(directions.size()));
  for (std::size_t k = 0; k < directions.size(); ++k) {
    means.col(static_cast<Eigen::Index>(k)) = weight_of(directions[k]) * directions[k].mean_normal;
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(means, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::MatrixXd axes = svd.matrixU() * svd.matrixV().transpose();
  for (std::size_t k = 0; k < directions.size(); ++k) {
    directions[k].axis = with_canonical_sign(axes.col(static_cast<Eigen::Index>(k)));
    directions[k].offset_rad = angle_between(directions[k].axis, directions[k].mean_normal);
  }
}

bool is_square(const Directions& directions, const OrthogonalTriadSettings& settings) {
  return std::all_of(directions.begin(), directions.end(), [&](const TriadDirection& direction) {
    return direction.offset_rad <= settings.max_offset_rad + direction.spread_rad;
  });
}

/// How many pairs or triads as square as this one are expected among `num_modes` random directions.
double chance_of(const Directions& directions, std::size_t num_modes) {
  double largest_cosine = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      largest_cosine = std::max(largest_cosine, cosine(directions[i].mean_normal, directions[j].mean_normal));
    }
  }
  const auto m = static_cast<double>(num_modes);
  if (directions.size() == 2) return m * (m - 1) / 2 * largest_cosine;
  return m * (m - 1) * (m - 2) / 6 * 2 / std::numbers::pi * std::pow(largest_cosine, 3);
}

/// Keeps the best of the pairs and triads that are shown to it.
class BestOf {
 public:
  BestOf(const Directions& modes, const OrthogonalTriadSettings& settings) : modes_(modes), settings_(settings) {}

  /// @param members  Indices of two or three modes, ascending: the last is the weakest.
  void consider(std::initializer_list<std::size_t> members) {
    Directions candidate;
    for (const std::size_t member : members) candidate.push_back(modes_[member]);
    if (score_of(candidate) <= score_of(directions)) return;
    make_square(candidate);
    if (!is_square(candidate, settings_)) return;
    const double candidates_chance = chance_of(candidate, *(members.end() - 1) + 1);
    if (candidates_chance > (members.size() == 2 ? settings_.max_chance_of_pair : settings_.max_chance_of_triad))
      return;
    directions = std::move(candidate);
    chance = candidates_chance;
  }

  Directions directions;
  double chance = 0;

 private:
  const Directions& modes_;
  const OrthogonalTriadSettings& settings_;
};

std::vector<std::uint8_t> labels_of(PointsView normals, const Directions& directions, double tolerance_rad) {
  std::vector<std::uint8_t> labels(normals.size(), kNoDirection);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    for (std::size_t k = 0; k < directions.size(); ++k) {
      if (cosine(normals[i], directions[k].mean_normal) > std::cos(tolerance_rad))
        labels[i] = static_cast<std::uint8_t>(k);
    }
  }
  return labels;
}

}  // namespace

void OrthogonalTriadSettings::validate() const {
  constexpr double kMaxAngle = std::numbers::pi / 8;  // two directions cannot claim the same normal
  require(tolerance_rad > 0 && tolerance_rad <= kMaxAngle, "tolerance_rad", tolerance_rad, "in (0, π/8]");
  require(max_offset_rad > 0 && max_offset_rad <= kMaxAngle, "max_offset_rad", max_offset_rad, "in (0, π/8]");
  require(is_positive(min_support), "min_support", min_support, "positive and finite");
  require(min_contrast > 1 && is_positive(min_contrast), "min_contrast", min_contrast, "greater than 1 and finite");
  require(is_positive(min_significance), "min_significance", min_significance, "positive and finite");
  require(is_positive(max_chance_of_pair), "max_chance_of_pair", max_chance_of_pair, "positive and finite");
  require(is_positive(max_chance_of_triad), "max_chance_of_triad", max_chance_of_triad, "positive and finite");
}

OrthogonalTriad orthogonal_triad(PointsView normals, const OrthogonalTriadSettings& settings,
                                 std::span<const double> weights) {
  settings.validate();
  require_valid(normals, weights);
  const Directions modes = find_modes(sorted_normals(normals, weights), settings);
  BestOf best(modes, settings);
  if (!modes.empty()) best.directions = {modes.front()};
  for (std::size_t a = 0; a < modes.size(); ++a) {
    for (std::size_t b = a + 1; b < modes.size(); ++b) {
      best.consider({a, b});
      for (std::size_t c = b + 1; c < modes.size(); ++c) best.consider({a, b, c});
    }
  }
  return {.directions = best.directions,
          .direction_of_normal = labels_of(normals, best.directions, settings.tolerance_rad),
          .num_modes = modes.size(),
          .chance = best.chance};
}

}  // namespace trysquare
