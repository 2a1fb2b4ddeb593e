// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/registered_map.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/point_statistics.h"
#include "trysquare/neighborhood/for_each_neighborhood.h"
#include "trysquare/neighborhood/point_index.h"
#include "trysquare/synthetic/street_corner.h"

#include <benchmark/benchmark.h>

#include <atomic>
#include <cstdint>
#include <vector>

namespace trysquare {
namespace {

const Execution kOneThread{.num_threads = 1};

/// Five scans of the simulated street, about 100,000 points: anyone can repeat it, and it takes a moment.
const RegisteredMap& street() {
  static const RegisteredMap map = [] {
    const SyntheticSequence sequence = simulate_street_corner({.num_scans = 5, .seed = 1});
    return assemble_map(sequence.scans, sequence.trajectory).map;
  }();
  return map;
}

void count_items(benchmark::State& state, std::size_t num_per_iteration) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(num_per_iteration));
}

void build_index(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(PointIndex(street(), kOneThread));
  count_items(state, street().points_in_map.size());
}
BENCHMARK(build_index)->Unit(benchmark::kMillisecond);

/// Visits all neighborhoods of `queries`; returns how many neighbors they have.
std::uint64_t visit(const PointIndex& index, PointsView queries, double radius_m) {
  std::atomic<std::uint64_t> neighbors_sum = 0;
  for_each_neighborhood(index, queries, {.radius_m = radius_m}, kOneThread, [&](const NeighborhoodBlock& block) {
    std::uint64_t sum = 0;
    for (const Moments& moments : block.moments) sum += moments.count;
    neighbors_sum += sum;
  });
  return neighbors_sum;
}

void measure_visit(benchmark::State& state, const PointIndex& index, PointsView queries, double radius_m) {
  std::uint64_t neighbors_sum = 0;
  for (auto _ : state) neighbors_sum = visit(index, queries, radius_m);
  count_items(state, queries.size());
  state.counters["neighbors"] = static_cast<double>(neighbors_sum) / static_cast<double>(queries.size());
}

void all_neighborhoods(benchmark::State& state) {
  const PointIndex index(street(), kOneThread);
  measure_visit(state, index, index.points(), 0.01 * static_cast<double>(state.range(0)));
}
BENCHMARK(all_neighborhoods)->ArgName("radius_cm")->Arg(30)->Arg(50)->Arg(100)->Unit(benchmark::kMillisecond);

/// Every n-th point: queries far apart share little of the search.
void sparse_neighborhoods(benchmark::State& state) {
  const PointIndex index(street(), kOneThread);
  std::vector<Eigen::Vector3d> queries;
  for (std::size_t i = 0; i < index.points().size(); i += static_cast<std::size_t>(state.range(0))) {
    queries.push_back(index.points()[i]);
  }
  measure_visit(state, index, queries, 1.0);
}
BENCHMARK(sparse_neighborhoods)->ArgName("every")->Arg(20)->Arg(500)->Unit(benchmark::kMillisecond);

void statistics_of_all_points(benchmark::State& state) {
  const PointIndex index(street(), kOneThread);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        point_statistics(index, index.points(), {.radius_m = 0.5}, Definition::kPaper, kOneThread));
  }
  count_items(state, index.points().size());
}
BENCHMARK(statistics_of_all_points)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trysquare

BENCHMARK_MAIN();
