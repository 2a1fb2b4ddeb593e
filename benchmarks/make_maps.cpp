// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/registered_map.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/io/calibration.h"
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/pipeline/sensor_trajectory.h"
#include "trysquare/synthetic/street_corner.h"

#include "problem.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <string>

namespace trysquare::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::size_t, 4> kNumScans = {1, 5, 10, 20};

/// A sequence in KITTI's layout: the poses are those of the camera, calib.txt leads to the LiDAR.
RegisteredMap kitti_map(const fs::path& folder) {
  const ScanFiles scans = open_scans((folder / "velodyne").string());
  const Trajectory world_from_camera =
      read_trajectory((folder / "poses.txt").string(), TrajectoryFormat::kKitti).trajectory;
  const Pose camera_from_lidar = read_kitti_calibration(folder / "calib.txt");
  return assemble_map(scans, sensor_trajectory_in_sensor_world(world_from_camera, camera_from_lidar),
                      {.num_scans = std::min(kNumScans.back(), scans.size())})
      .map;
}

/// About as many points a scan as KITTI's sensor gives.
RegisteredMap simulated_map() {
  const SyntheticSequence street = simulate_street_corner(
      {.num_scans = kNumScans.back(), .sensor = {.num_beams = 64, .num_azimuths = 1900}, .seed = 1});
  return assemble_map(street.scans, street.trajectory).map;
}

/// All maps are in the frame of scan 0, so that a smaller one is the beginning of a larger one.
void write_maps(const fs::path& folder, const RegisteredMap& map) {
  fs::create_directories(folder);
  for (const std::size_t num_scans : kNumScans) {
    if (num_scans > map.num_scans) continue;
    const auto end = std::ranges::lower_bound(map.scan_of_point, static_cast<std::uint32_t>(num_scans));
    const auto num_points = static_cast<std::size_t>(end - map.scan_of_point.begin());
    const fs::path path = folder / ("map_" + std::to_string(num_scans) + ".f64");
    write_map_file(path, std::span(map.points_in_map).first(num_points),
                   std::span(map.scan_of_point).first(num_points));
    std::printf("%s: %zu points\n", path.string().c_str(), num_points);
  }
}

}  // namespace
}  // namespace trysquare::bench

/// Writes the maps that compare.py measures: of a sequence in KITTI's layout, or else of the simulated street.
int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) {
    std::fprintf(stderr, "usage: trysquare_benchmark_maps OUTPUT_FOLDER [KITTI_FOLDER]\n");
    return 2;
  }
  try {
    trysquare::bench::write_maps(argv[1],
                                 argc == 3 ? trysquare::bench::kitti_map(argv[2]) : trysquare::bench::simulated_map());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
  }
  return 0;
}
