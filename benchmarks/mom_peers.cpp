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
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <numeric>
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

/// A sequence in KITTI's layout whose scans come in the map frame, that of scan 0.
struct Sequence {
  explicit Sequence(const fs::path& folder)
      : scans(open_scans((folder / "velodyne").string())),
        trajectory(sensor_trajectory_in_sensor_world(
            read_trajectory((folder / "poses.txt").string(), TrajectoryFormat::kKitti).trajectory,
            read_kitti_calibration(folder / "calib.txt"))),
        map_from_world(general_inverse(trajectory.world_from_scan[0])) {}

  std::vector<Eigen::Vector3d> points_of_scan(std::size_t i) const {
    std::vector<Eigen::Vector3d> points = scans.load(i).points_in_scan;
    const Pose map_from_scan = map_from_world * trajectory.world_from_scan[i];
    for (Eigen::Vector3d& point : points) point = map_from_scan * point;
    return points;
  }

  ScanFiles scans;
  Trajectory trajectory;
  Pose map_from_world;
};

struct Arguments {
  fs::path folder;
  std::string engine = "trysquare";
  bool local = false;
  double radius_m = 1.0;
  int num_threads = 1;
};

/// Reading the files included: as a user calls it.
nlohmann::ordered_json measure_trysquare(const Arguments& arguments) {
  const Stopwatch all;
  const Sequence sequence(arguments.folder);
  const OrthogonalSubset subset = choose_queries(sequence.scans.load(0), arguments.local);
  const PointsOfScan points_of_scan = [&](std::size_t i) { return sequence.points_of_scan(i); };
  const OrthogonalStatistics statistics = orthogonal_statistics(sequence.scans.size(), points_of_scan, subset,
                                                                {.radius_m = arguments.radius_m, .min_neighbors = 4},
                                                                {.num_threads = arguments.num_threads});
  const PointStatistics& points = statistics.directions[0].points;
  const auto median = median_of_defined(points.plane_variances);
  const Elapsed elapsed = all.elapsed();
  return {
      {"user_s", elapsed.user_s},
      {"system_s", elapsed.system_s},
      {"wall_s", elapsed.wall_s},
      {"median_m2", *median},
      {"neighbors_sum", std::accumulate(points.num_neighbors.begin(), points.num_neighbors.end(), std::uint64_t{0})},
      {"peak_rss_bytes", peak_resident_bytes()}};
}

/// Tree and queries only: neither reading nor moving the points.
nlohmann::ordered_json measure_nanoflann(const Arguments& arguments) {
  const Sequence sequence(arguments.folder);
  Problem problem{.queries_are_all_points = false, .radius_m = arguments.radius_m};
  for (std::size_t i = 0; i < sequence.scans.size(); ++i) {
    const std::vector<Eigen::Vector3d> points = sequence.points_of_scan(i);
    problem.points_in_map.insert(problem.points_in_map.end(), points.begin(), points.end());
  }
  problem.subset_in_map = choose_queries(sequence.scans.load(0), arguments.local).directions[0].points_in_map;
  const Outcome outcome = run_nanoflann(problem);
  return {{"user_s", outcome.build.user_s + outcome.query.user_s},
          {"neighbors_sum", outcome.neighbors_sum},
          {"peak_rss_bytes", peak_resident_bytes()}};
}

}  // namespace
}  // namespace trysquare::bench

/// The neighborhoods of MOM from a folder in KITTI's layout, by one engine; prints one line of JSON.
int main(int argc, char** argv) {
  using namespace trysquare::bench;
  Arguments arguments;
  CLI::App app("MOM's neighborhoods of 2000 queries: trysquare with reading the scans, nanoflann without");
  app.add_option("folder", arguments.folder, "velodyne/, poses.txt and calib.txt")->required();
  app.add_option("--engine", arguments.engine, "which one")->check(CLI::IsMember({"trysquare", "nanoflann"}));
  app.add_flag("--local", arguments.local, "queries in a patch before the car, not all over the scan");
  app.add_option("--radius", arguments.radius_m, "[m]")->check(CLI::PositiveNumber);
  app.add_option("--threads", arguments.num_threads, "threads of trysquare")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  try {
    nlohmann::ordered_json result = {{"engine", arguments.engine}, {"queries", arguments.local ? "local" : "spread"}};
    result.update(arguments.engine == "trysquare" ? measure_trysquare(arguments) : measure_nanoflann(arguments));
    std::puts(result.dump().c_str());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
