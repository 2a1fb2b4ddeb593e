// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/pose.h"
#include "trysquare/io/calibration.h"
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/orthogonal_statistics.h"
#include "trysquare/pipeline/sensor_trajectory.h"
#include "trysquare/stats/median.h"

#include "peers.h"
#include "problem.h"
#include "process_usage.h"
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

namespace trysquare::bench {
namespace {

namespace fs = std::filesystem;

/// 2000 points of scan 0: of all of it, or of a patch before the car.
OrthogonalSubset choose_queries(const Scan& scan, bool local) {
  constexpr std::size_t kNumQueries = 2000;
  std::vector<Eigen::Vector3d> candidates;
  for (const Eigen::Vector3d& point : scan.points_in_scan) {
    const bool in_patch = point.x() > 4 && point.x() < 16 && std::abs(point.y()) < 8;
    if (!local || in_patch) candidates.push_back(point);
  }
  OrthogonalSubset::Direction direction;
  const std::size_t step = std::max<std::size_t>(candidates.size() / kNumQueries, 1);
  for (std::size_t i = 0; i < candidates.size() && direction.points_in_map.size() < kNumQueries; i += step) {
    direction.points_in_map.push_back(candidates[i]);
  }
  return {{direction}};
}

/// Reading the files included: as a user calls it.
nlohmann::ordered_json measure(const fs::path& folder, bool local, double radius_m, int num_threads) {
  const Stopwatch all;
  const ScanFiles scans = open_scans((folder / "velodyne").string());
  const Trajectory world_from_camera =
      read_trajectory((folder / "poses.txt").string(), TrajectoryFormat::kKitti).trajectory;
  const Trajectory trajectory =
      sensor_trajectory_in_sensor_world(world_from_camera, read_kitti_calibration(folder / "calib.txt"));
  const Pose map_from_world = general_inverse(trajectory.world_from_scan[0]);
  const OrthogonalSubset subset = choose_queries(scans.load(0), local);
  const PointsOfScan points_of_scan = [&](std::size_t i) {
    std::vector<Eigen::Vector3d> points = scans.load(i).points_in_scan;
    const Pose map_from_scan = map_from_world * trajectory.world_from_scan[i];
    for (Eigen::Vector3d& point : points) point = map_from_scan * point;
    return points;
  };
  const OrthogonalStatistics statistics = orthogonal_statistics(
      scans.size(), points_of_scan, subset, {.radius_m = radius_m, .min_neighbors = 4}, {.num_threads = num_threads});
  const auto median = median_of_defined(statistics.directions[0].points.plane_variances);
  const Elapsed elapsed = all.elapsed();
  return {{"engine", "trysquare"},
          {"queries", local ? "local" : "spread"},
          {"user_s", elapsed.user_s},
          {"system_s", elapsed.system_s},
          {"wall_s", elapsed.wall_s},
          {"median_m2", *median},
          {"peak_rss_bytes", peak_resident_bytes()}};
}

}  // namespace
}  // namespace trysquare::bench

/// The neighborhoods of MOM from a folder in KITTI's layout, scans streaming by; prints one line of JSON.
int main(int argc, char** argv) {
  std::filesystem::path folder;
  bool local = false;
  double radius_m = 1.0;
  int num_threads = 1;
  CLI::App app("MOM's neighborhoods of 2000 queries, reading the scans included");
  app.add_option("folder", folder, "velodyne/, poses.txt and calib.txt")->required();
  app.add_flag("--local", local, "queries in a patch before the car, not all over the scan");
  app.add_option("--radius", radius_m, "[m]")->check(CLI::PositiveNumber);
  app.add_option("--threads", num_threads, "threads")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    std::puts(trysquare::bench::measure(folder, local, radius_m, num_threads).dump().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
