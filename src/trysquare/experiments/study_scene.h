// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/synthetic/plane_world.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace trysquare {

/// One point of one scan. It moves with the scan when the poses do.
struct ScanPoint {
  std::uint32_t scan = 0;
  std::uint32_t index = 0;
};

/// The points at which MOM and OMME of a study look, direction by direction.
struct StudySubset {
  struct Direction {
    Eigen::Vector3d normal_in_map = Eigen::Vector3d::Zero();  ///< By the true poses.
    std::vector<ScanPoint> points;
  };
  std::string suffix;  ///< Of the metrics' names: "" or "_paper", for instance.
  std::vector<Direction> directions;
  std::string reason;  ///< Why there are fewer than three; empty otherwise.
};

/// What all trajectories of a study have in common: scans, true poses, and the points that are asked for metrics. These
/// stay the same points, so that metrics of two trajectories differ by their poses only.
struct StudyScene {
  std::vector<std::vector<Eigen::Vector3d>> points_in_scan;  ///< Scan by scan [m].
  Trajectory true_poses;
  std::vector<ScanPoint> queries;  ///< Of MME and MPV.
  std::vector<StudySubset> subsets;

  /// @throws InvalidArgument  if there are fewer than two scans, not a pose for each, or a point that is not there.
  void validate() const;
};

/// How a scene is made.
struct StudySceneSettings {
  std::size_t num_queries = 300;              ///< At least so many of the points, evenly spread; >= 1.
  std::size_t num_points_per_direction = 25;  ///< Of an orthogonal subset, at most, evenly spread; >= 1.

  void validate() const;  ///< @throws InvalidArgument
};

/// `num_scans` scans of discs from poses that are all the identity. The orthogonal subset is known: points of the first
/// scan on discs 0, 1 and 2, suffix "".
///
/// @param discs     Three at least.
/// @param world     Radius and noise of the points; its seed is that of the points.
/// @throws InvalidArgument  if there are fewer than three discs, a setting is out of range, or num_scans < 2.
StudyScene scene_of_discs(std::span<const Disc> discs, std::size_t num_scans, const PlaneWorldSettings& world,
                          const StudySceneSettings& settings = {});

/// An orthogonal subset of a scene of scans, and the suffix of the metrics on it.
struct StudySubsetSettings {
  std::string suffix;
  OrthogonalSubsetSettings extraction{};
};

/// Scans and their true poses. Each orthogonal subset is extracted once, from the map of the true poses.
///
/// @param first, num_scans  Which scans: [first, first + num_scans).
/// @param radius_m          Of the neighborhoods of the extraction [m].
/// @throws InvalidArgument  if a setting is out of range, num_scans < 2, or there are not so many scans or poses.
/// @throws IoError          from ScanSequence::load().
StudyScene scene_of_scans(const ScanSequence& scans, const Trajectory& true_poses, std::size_t first,
                          std::size_t num_scans, std::span<const StudySubsetSettings> subsets, double radius_m,
                          const StudySceneSettings& settings = {}, const Execution& execution = {});

}  // namespace trysquare
