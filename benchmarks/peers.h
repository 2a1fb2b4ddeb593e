// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "problem.h"
#include "process_usage.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace trysquare::bench {

/// What one engine found, and how long it took.
struct Outcome {
  Elapsed build;
  Elapsed query;
  std::uint64_t neighbors_sum = 0;  ///< Over all queries: two engines that agree have found the same neighborhoods.
  std::optional<double> mpv;        ///< [m²]
  std::optional<double> mme;        ///< [nats]
};

/// One engine by the name that --engine knows.
struct Engine {
  const char* name;
  std::string version;
  bool uses_threads = false;
  Outcome (*run)(const Problem&) = nullptr;
};

/// The engines that this program was built with.
std::span<const Engine> engines();

/// trysquare as its users get it: plane variance and entropy of every query, kept.
Outcome run_trysquare(const Problem& problem);
/// The bare visitor, which keeps nothing: what for_each_neighborhood alone costs.
Outcome run_trysquare_visitor(const Problem& problem);
/// kd-tree over doubles, lists of neighbors.
Outcome run_nanoflann(const Problem& problem);
std::string nanoflann_version();
/// pcl::KdTreeFLANN over floats: PCL's clouds know no doubles.
Outcome run_pcl(const Problem& problem);
std::string pcl_version();
/// The kd-tree of small_gicp, walked by us: it has no search by radius of its own.
Outcome run_small_gicp(const Problem& problem);

}  // namespace trysquare::bench
