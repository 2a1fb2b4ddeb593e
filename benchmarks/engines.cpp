// SPDX-License-Identifier: Apache-2.0
#include "peers.h"

#include <vector>

namespace trysquare::bench {

std::span<const Engine> engines() {
  static const std::vector<Engine> all = {
#ifdef TRYSQUARE_BENCH_TRYSQUARE
      {"trysquare", TRYSQUARE_BENCH_TRYSQUARE, true, run_trysquare},
      {"trysquare-visitor", TRYSQUARE_BENCH_TRYSQUARE, true, run_trysquare_visitor},
#endif
      {"nanoflann", nanoflann_version(), false, run_nanoflann},
#ifdef TRYSQUARE_BENCH_PCL
      {"pcl", pcl_version(), false, run_pcl},
#endif
#ifdef TRYSQUARE_BENCH_SMALL_GICP
      {"small_gicp", TRYSQUARE_BENCH_SMALL_GICP, false, run_small_gicp},
#endif
  };
  return all;
}

}  // namespace trysquare::bench
