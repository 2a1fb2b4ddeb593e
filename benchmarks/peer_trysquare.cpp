// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/mme.h"
#include "trysquare/metrics/mpv.h"
#include "trysquare/metrics/point_statistics.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"
#include "trysquare/neighborhood/point_index.h"

#include "peers.h"

#include <atomic>
#include <numeric>

namespace trysquare::bench {

Outcome run_trysquare(const Problem& problem) {
  Outcome outcome;
  const Execution execution{.num_threads = problem.num_threads};
  const Stopwatch build;
  const PointIndex index(problem.points_in_map, problem.scan_of_point, problem.num_scans, execution);
  outcome.build = build.elapsed();

  const Stopwatch query;
  const PointStatistics points =
      point_statistics(index, problem.queries_in_map(), {.radius_m = problem.radius_m}, Definition::kPaper, execution);
  outcome.mpv = mpv(points).value;
  outcome.mme = mme(points).value;
  outcome.query = query.elapsed();
  outcome.neighbors_sum = std::accumulate(points.num_neighbors.begin(), points.num_neighbors.end(), std::uint64_t{0});
  return outcome;
}

Outcome run_trysquare_visitor(const Problem& problem) {
  Outcome outcome;
  const Execution execution{.num_threads = problem.num_threads};
  const Stopwatch build;
  const PointIndex index(problem.points_in_map, problem.scan_of_point, problem.num_scans, execution);
  outcome.build = build.elapsed();

  const Stopwatch query;
  std::atomic<std::uint64_t> neighbors_sum = 0;
  for_each_neighborhood(index, problem.queries_in_map(), {.radius_m = problem.radius_m}, execution,
                        [&](const NeighborhoodBlock& block) {
                          std::uint64_t sum = 0;
                          for (const Moments& moments : block.moments) sum += moments.count;
                          neighbors_sum += sum;
                        });
  outcome.query = query.elapsed();
  outcome.neighbors_sum = neighbors_sum;
  return outcome;
}

}  // namespace trysquare::bench
