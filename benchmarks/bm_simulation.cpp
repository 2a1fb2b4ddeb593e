// SPDX-License-Identifier: Apache-2.0
#include "trysquare/simulation/drive.h"
#include "trysquare/simulation/ray_caster.h"
#include "trysquare/simulation/simulated_scans.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

namespace trysquare {
namespace {

/// items_per_second are rays, of one thread.
void count_rays(benchmark::State& state, const SensorModel& sensor) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sensor.num_rays()));
}

/// Whole scans, with noise, along a route.
void measure_scans(benchmark::State& state, WorldStyle style, const char* preset, bool rolling_shutter, int num_cars) {
  constexpr std::size_t kNumScans = 50;
  const SimulatedWorld world = make_world(style, 1, {.num_moving_cars = num_cars});
  SensorModel sensor = sensor_preset(preset);
  sensor.rolling_shutter = rolling_shutter;
  const double step_m = style == WorldStyle::kRoom ? 0.1 : 1;
  const SimulatedScans scans(world, drive(world, {.num_scans = kNumScans, .step_m = step_m}), sensor, 1);
  std::size_t index = 0;
  std::size_t num_points = 0;
  for (auto _ : state) {
    num_points += scans.load(index).points_in_scan.size();
    index = (index + 1) % kNumScans;
  }
  count_rays(state, sensor);
  state.counters["triangles"] = static_cast<double>(world.mesh.triangles.size());
  state.counters["points"] = static_cast<double>(num_points) / static_cast<double>(state.iterations());
}

void carla32_in_street(benchmark::State& state) { measure_scans(state, WorldStyle::kStreet, "carla32", false, 0); }
void hdl64_in_grid(benchmark::State& state) { measure_scans(state, WorldStyle::kTownGrid, "hdl64", false, 0); }
void hdl64_in_suburb(benchmark::State& state) { measure_scans(state, WorldStyle::kTownSuburb, "hdl64", false, 0); }
void hdl64_in_old_town(benchmark::State& state) { measure_scans(state, WorldStyle::kTownOld, "hdl64", false, 0); }
void hdl64_rolling_among_cars(benchmark::State& state) {
  measure_scans(state, WorldStyle::kTownSuburb, "hdl64", true, 24);
}
void depth_camera_in_room(benchmark::State& state) {
  measure_scans(state, WorldStyle::kRoom, "depth-camera", false, 0);
}
BENCHMARK(carla32_in_street)->Unit(benchmark::kMillisecond);
BENCHMARK(hdl64_in_grid)->Unit(benchmark::kMillisecond);
BENCHMARK(hdl64_in_suburb)->Unit(benchmark::kMillisecond);
BENCHMARK(hdl64_in_old_town)->Unit(benchmark::kMillisecond);
BENCHMARK(hdl64_rolling_among_cars)->Unit(benchmark::kMillisecond);
BENCHMARK(depth_camera_in_room)->Unit(benchmark::kMillisecond);

/// Building the world and the index of its triangles.
void make_suburb(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(make_world(WorldStyle::kTownSuburb, 1).mesh.triangles.data());
}
BENCHMARK(make_suburb)->Unit(benchmark::kMillisecond);

void index_suburb(benchmark::State& state) {
  const SimulatedWorld world = make_world(WorldStyle::kTownSuburb, 1);
  for (auto _ : state) {
    const RayCaster caster(world.mesh);
    benchmark::DoNotOptimize(&caster);
  }
}
BENCHMARK(index_suburb)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace trysquare

BENCHMARK_MAIN();
