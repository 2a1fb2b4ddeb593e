// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/io/write_bin.h"
#include "trysquare/io/write_trajectory.h"
#include "trysquare/synthetic/perturb.h"
#include "trysquare/synthetic/street_corner.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>

namespace trysquare {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kNumScans = 40;
constexpr std::uint64_t kSeed = 1;

/// Poses as an odometry might estimate them: good at first, then worse, so that the heat map has something to show.
Trajectory estimate(const Trajectory& truth) {
  const Trajectory good = perturb(truth, {.translation_sigma_m = 0.01, .rotation_sigma_rad = 0.0002, .seed = kSeed});
  const Trajectory bad = perturb(truth, {.translation_sigma_m = 0.08, .rotation_sigma_rad = 0.001, .seed = kSeed});
  Trajectory result = good;
  for (std::size_t i = kNumScans / 2; i < 2 * kNumScans / 3; ++i) result.world_from_scan[i] = bad.world_from_scan[i];
  return result;
}

/// A data set in KITTI's layout, with the true poses beside the estimated ones.
void write_data_set(const fs::path& folder) {
  fs::create_directories(folder / "velodyne");
  const SyntheticSequence street = simulate_street_corner({.num_scans = kNumScans, .step_m = 0.4, .seed = kSeed});
  std::string times;
  for (std::size_t i = 0; i < street.scans.size(); ++i) {
    write_kitti_bin(folder / "velodyne" / fmt::format("{:06}.bin", i), street.scans.load(i).points_in_scan);
    times += fmt::format("{:.1f}\n", 0.1 * static_cast<double>(i));
  }
  write_file(folder / "times.txt", times);
  write_trajectory(folder / "reference.txt", street.trajectory, TrajectoryFormat::kKitti);
  write_trajectory(folder / "poses.txt", estimate(street.trajectory), TrajectoryFormat::kKitti);
}

}  // namespace
}  // namespace trysquare

/// Writes the data set that `./run demo` evaluates: trysquare_demo FOLDER.
int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "usage: trysquare_demo FOLDER\n");
    return 2;
  }
  try {
    trysquare::write_data_set(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return 3;
  }
  return 0;
}
