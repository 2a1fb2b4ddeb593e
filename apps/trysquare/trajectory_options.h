// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/trajectory.h"
#include "trysquare/report/trajectory_json.h"
#include "trysquare/trajectory/alignment.h"
#include "trysquare/trajectory/association.h"
#include "trysquare/trajectory/pose_relation.h"
#include "trysquare/trajectory/projection.h"

#include "common_options.h"
#include <CLI/CLI.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace trysquare::app {

/// The options that `ape` and `rpe` share. Names are evo's where evo has the option.
struct TrajectoryOptions {
  CommonOptions common;
  std::string reference;
  std::string estimate;
  std::string format = "auto";
  std::string relation = "trans_part";
  bool align = false;
  bool correct_scale = false;
  bool align_origin = false;
  std::size_t num_poses_to_align = 0;
  std::string plane;
  std::string unit;
  std::vector<double> quantiles = {0.5, 0.75, 0.9, 0.95, 0.99};
  AssociationSettings association;
  std::optional<double> t_start_s;
  std::optional<double> t_end_s;
  std::optional<std::size_t> downsample;
  std::vector<double> motion_filter;  ///< Empty, or metres and degrees.
  std::string transform_left;
  std::string transform_right;
  std::string extrinsic;
  bool estimate_extrinsic = false;

  Alignment alignment() const;
  std::optional<Plane> projection() const { return plane.empty() ? std::nullopt : plane_named(plane); }
};

void add_trajectory_options(CLI::App& verb, TrajectoryOptions& options);

/// Two trajectories that were read, filtered, transformed and associated.
struct TrajectoryPair {
  AssociatedTrajectories poses;
  TrajectoryErrorsFacts facts;
};

/// @throws IoError          if a file cannot be read, or both have no pose in common.
/// @throws InvalidArgument  if options are out of range or contradict each other.
TrajectoryPair load_trajectories(const TrajectoryOptions& options);

}  // namespace trysquare::app
