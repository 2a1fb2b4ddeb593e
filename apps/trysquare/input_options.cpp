// SPDX-License-Identifier: Apache-2.0
#include "input_options.h"

#include <string>

namespace trysquare::app {

void add_scan_options(CLI::App& verb, InputOptions& options) {
  const std::string group = "Selection";
  verb.add_option("--every", options.every, "Take every n-th scan")->capture_default_str()->group(group);
  verb.add_option("--first", options.first, "First scan, from 0")->capture_default_str()->group(group);
  verb.add_option("--last", options.last, "Last scan, inclusive")->group(group);
}

void add_range_options(CLI::App& verb, double& min_range_m, double& max_range_m) {
  const std::string group = "Selection";
  verb.add_option("--min-range", min_range_m, "Drop points nearer to the sensor [m]")
      ->capture_default_str()
      ->group(group);
  verb.add_option("--max-range", max_range_m, "Drop points farther from the sensor [m]")->group(group);
}

void add_pose_options(CLI::App& verb, InputOptions& options) {
  const std::string group = "Poses";
  verb.add_option("--poses-format", options.poses_format, "Format of the poses")
      ->check(CLI::IsMember(poses_formats()))
      ->capture_default_str()
      ->group(group);
  verb.add_option(
          "--calib", options.calibration,
          "KITTI calib.txt: its Tr takes the poses from the camera to the scanner; a calib.txt beside the poses "
          "is used by itself")
      ->group(group);
  verb.add_flag("--no-calib", options.no_calibration, "Do not use a calib.txt beside the poses")->group(group);
  verb.add_flag("--left-handed", options.left_handed,
                "Points, poses and extrinsic are left-handed, as CARLA writes them: y is negated")
      ->group(group);
  verb.add_option("--extrinsic", options.extrinsic, "body_from_sensor: a file, or 12 or 16 numbers in quotes")
      ->group(group);
  verb.add_option("--t-max-diff", options.max_time_difference_s,
                  "Where scans and poses have time stamps, a scan takes the nearest pose within this [s]")
      ->capture_default_str()
      ->group(group);
}

}  // namespace trysquare::app
