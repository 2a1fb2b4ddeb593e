// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/normal_clusters.h"

#include "trysquare/core/error.h"
#include "trysquare/metrics/internal/complete_linkage.h"
#include "trysquare/metrics/internal/nearest_neighbor_chain.h"
#include "trysquare/metrics/internal/ward_linkage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>

namespace trysquare {
namespace {

void validate(PointsView normals) {
  constexpr double kTolerance = 1e-6;
  constexpr std::size_t kLimit = std::size_t{1} << 31;  // a number for every normal and every merge
  if (normals.size() >= kLimit) {
    throw InvalidArgument(fmt::format("normals has {} vectors: it must be fewer than {}", normals.size(), kLimit));
  }
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!normals[i].allFinite()) throw InvalidArgument(fmt::format("normals[{}] is not finite", i));
    const double length = normals[i].norm();
    if (!(std::abs(length - 1) <= kTolerance)) {
      throw InvalidArgument(fmt::format("normals[{}] has the length {}, expected 1", i, length));
    }
  }
}

bool comes_before(const Eigen::Vector3d& n, const Eigen::Vector3d& m) {
  return std::tie(n.x(), n.y(), n.z()) < std::tie(m.x(), m.y(), m.z());
}

/// Without signs n and −n become one. Nothing here tells −0 from 0.
Eigen::Vector3d canonical(const Eigen::Vector3d& normal, bool sign_free) {
  const Eigen::Vector3d opposite = -normal;
  return sign_free && comes_before(normal, opposite) ? opposite : normal;
}

/// What is left of the input once order, repetition and free signs are taken away; sorted.
struct DistinctNormals {
  std::vector<Eigen::Vector3d> normals;
  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> of_input;  ///< Which of them every normal of the input is.
};

DistinctNormals distinct(PointsView normals, bool sign_free) {
  std::vector<Eigen::Vector3d> all;
  all.reserve(normals.size());
  for (const Eigen::Vector3d& normal : normals) all.push_back(canonical(normal, sign_free));
  std::vector<std::uint32_t> order(all.size());
  std::iota(order.begin(), order.end(), std::uint32_t{0});
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return comes_before(all[a], all[b]); });
  DistinctNormals result;
  result.of_input.resize(all.size());
  for (const std::uint32_t i : order) {
    if (result.normals.empty() || result.normals.back() != all[i]) {
      result.normals.push_back(all[i]);
      result.counts.push_back(0);
    }
    ++result.counts.back();
    result.of_input[i] = static_cast<std::uint32_t>(result.normals.size() - 1);
  }
  return result;
}

/// The least double whose root is not below the cut: comparing squares with it is comparing distances with the cut.
double squared_limit(double cut) {
  double limit = cut * cut;
  while (std::sqrt(limit) >= cut) limit = std::nextafter(limit, 0.0);
  while (std::sqrt(limit) < cut) limit = std::nextafter(limit, std::numeric_limits<double>::infinity());
  return limit;
}

std::vector<std::uint32_t> clusters_of(const DistinctNormals& distinct, const NormalClusterSettings& settings) {
  const double limit = squared_limit(settings.cut);
  if (settings.linkage == Linkage::kWard) {
    return internal::NearestNeighborChain(internal::WardLinkage(distinct.normals, distinct.counts), limit).run();
  }
  return internal::NearestNeighborChain(internal::CompleteLinkage(distinct.normals, settings.sign_free), limit).run();
}

}  // namespace

void NormalClusterSettings::validate() const {
  if (!(cut > 0 && std::isfinite(cut))) {
    throw InvalidArgument(fmt::format("cut = {} is out of range: it must be positive and finite", cut));
  }
  if (linkage == Linkage::kWard && sign_free) {
    throw InvalidArgument("sign_free = true is out of range: it must be false for Ward's linkage");
  }
}

std::vector<std::uint32_t> cluster_normals(PointsView normals, const NormalClusterSettings& settings) {
  settings.validate();
  validate(normals);
  if (normals.empty()) return {};
  const DistinctNormals sorted = distinct(normals, settings.sign_free);
  const std::vector<std::uint32_t> cluster_of = clusters_of(sorted, settings);
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> label_of(cluster_of.size(), kNone);
  std::vector<std::uint32_t> labels;
  labels.reserve(normals.size());
  std::uint32_t num_labels = 0;
  for (const std::uint32_t normal : sorted.of_input) {
    std::uint32_t& label = label_of[cluster_of[normal]];
    if (label == kNone) label = num_labels++;
    labels.push_back(label);
  }
  return labels;
}

}  // namespace trysquare
