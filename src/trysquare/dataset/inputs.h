// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/io/scan_files.h"
#include "trysquare/io/trajectory_file.h"
#include "trysquare/metrics/orthogonal_subset.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace trysquare {

/// Which scans are meant and where they stood: the options of the command under their names, and those of Python.
struct InputOptions {
  std::string scans;
  std::string poses;
  std::string reference;
  std::string poses_format = "auto";
  std::string calibration;
  std::string extrinsic;
  bool no_calibration = false;
  bool left_handed = false;  ///< Points, poses and extrinsic are (CARLA): y is negated in all of them.
  std::size_t every = 1;
  std::size_t first = 0;
  std::optional<std::size_t> last;
  double max_time_difference_s = 0.01;
};

/// What a calibration does to poses: of the body that they were read for, to those of the sensor.
struct Extrinsic {
  Pose body_from_sensor;
  std::string description;         ///< For the report, e.g. "calib.txt:Tr".
  bool moves_world_along = false;  ///< KITTI: the world is the first frame of the body, and becomes the sensor's.

  Trajectory apply(const Trajectory& world_from_body) const;
  Trajectory undo(const Trajectory& world_from_sensor) const;  ///< The poses of the body, in its world.
};

/// Scans and poses as the options select them, one pose per scan.
struct Inputs {
  std::unique_ptr<ScanSequence> scans;
  Trajectory poses_as_read;             ///< Of the selected scans, without the extrinsic, in their own handedness.
  Trajectory world_from_scan;           ///< With it.
  Trajectory all_poses;                 ///< Likewise, of the whole file with its stamps: also those of no scan.
  std::optional<Trajectory> reference;  ///< Of the selected scans, with its own extrinsic.
  std::optional<Extrinsic> extrinsic;   ///< Right-handed, as everything here.
  std::optional<Extrinsic> reference_extrinsic;  ///< A calib.txt beside the reference is for the reference only.
  TrajectoryFormat format{};
  std::vector<Diagnostic> warnings;
};

/// @throws IoError          if something cannot be read, or numbers of scans and poses differ.
/// @throws InvalidArgument  if the selection is empty or options contradict each other.
Inputs load_inputs(const InputOptions& options);

/// Several trajectories of the same scans.
struct ComparedInputs {
  /// One of them.
  struct Poses {
    std::string poses;           ///< As typed.
    Trajectory world_from_scan;  ///< Of the selected scans, with its own extrinsic.
    std::optional<Extrinsic> extrinsic;
    TrajectoryFormat format{};
    std::vector<Diagnostic> warnings;
  };
  std::unique_ptr<ScanSequence> scans;  ///< Those for which all have a pose.
  std::vector<Poses> trajectories;
};

/// As load_inputs(), but with each of `poses` in the place of options.poses. Scans for which one of them has no pose
/// are left out for all.
/// @throws IoError          likewise, and if no scan has a pose of each.
/// @throws InvalidArgument  likewise.
ComparedInputs load_compared_inputs(const InputOptions& options, const std::vector<std::string>& poses);

/// Poses of the sensor in the frame and convention of the file that the inputs came from: the way back.
/// @param world_from_scan  One pose per selected scan.
Trajectory poses_as_in_file(const Trajectory& world_from_scan, const Inputs& inputs, const InputOptions& options);

/// A precomputed orthogonal subset, one file per direction, in the frame in which it was stored.
/// @throws IoError  if a file cannot be read or there are more than three.
OrthogonalSubset read_subset(const std::string& spec);

/// Scans without poses, as the options select them.
std::unique_ptr<ScanSequence> load_scans(const InputOptions& options);

/// What --poses-format may be.
std::vector<std::string> poses_formats();

/// The format of one of those; nullopt for "auto".
/// @throws InvalidArgument  for any other name.
std::optional<TrajectoryFormat> format_option(const std::string& name);

}  // namespace trysquare
