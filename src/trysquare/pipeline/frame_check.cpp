// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/frame_check.h"

#include "trysquare/core/handedness.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/mpv.h"
#include "trysquare/metrics/overlap.h"
#include "trysquare/metrics/point_statistics.h"
#include "trysquare/pipeline/sensor_trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

/// A few scans in memory: every candidate looks at the same ones.
class SomeScans : public ScanSequence {
 public:
  SomeScans(const ScanSequence& all, const std::vector<std::size_t>& chosen) {
    for (const std::size_t index : chosen) {
      scans_.push_back(all.load(index));
      names_.push_back(all.name(index));
    }
  }
  std::size_t size() const override { return scans_.size(); }
  Scan load(std::size_t index) const override { return scans_[index]; }
  std::string name(std::size_t index) const override { return names_[index]; }

  std::size_t num_points() const {
    std::size_t sum = 0;
    for (const Scan& scan : scans_) sum += scan.points_in_scan.size();
    return sum;
  }

 private:
  std::vector<Scan> scans_;
  std::vector<std::string> names_;
};

/// Every second of the 20 scans in the middle of the sequence: near enough to overlap, far enough to have moved.
std::vector<std::size_t> middle_scans(std::size_t num_scans) {
  const std::size_t span = std::min<std::size_t>(num_scans, 20);
  const std::size_t step = span >= 6 ? 2 : 1;
  std::vector<std::size_t> chosen;
  for (std::size_t i = (num_scans - span) / 2; i < (num_scans + span) / 2; i += step) chosen.push_back(i);
  return chosen;
}

struct Candidate {
  std::string code;
  std::string mistake;
  std::string remedy;
  Trajectory trajectory;
};

/// Axes of a camera (x right, y down, z forward) from those of a LiDAR (x forward, y left, z up).
Pose camera_from_lidar_axes() { return {.rotation = (Eigen::Matrix3d() << 0, -1, 0, 0, 0, -1, 1, 0, 0).finished()}; }

Trajectory inverted(const Trajectory& trajectory) {
  Trajectory result = trajectory;
  for (Pose& pose : result.world_from_scan) pose = general_inverse(pose);
  return result;
}

std::vector<Candidate> likely_corrections(const Trajectory& trajectory, const std::optional<Pose>& body_from_sensor) {
  std::vector<Candidate> candidates;
  if (body_from_sensor) {
    const Pose sensor_from_body = general_inverse(*body_from_sensor);
    const Trajectory of_body = sensor_trajectory(trajectory, sensor_from_body);
    candidates.push_back({"extrinsic_not_needed", "the poses look as if they were in the frame of the scanner already",
                          "leave the calibration out (--no-calib, no --extrinsic)", of_body});
    candidates.push_back({"extrinsic_inverted", "the calibration looks inverted",
                          "give its inverse (body_from_sensor, not sensor_from_body)",
                          sensor_trajectory(of_body, sensor_from_body)});
  } else {
    candidates.push_back({"camera_frame", "the poses look like those of a camera, not of the scanner",
                          "give the calibration (--calib with KITTI's calib.txt, or --extrinsic)",
                          sensor_trajectory(trajectory, camera_from_lidar_axes())});
  }
  candidates.push_back({"poses_inverted", "the poses look inverted: from the world to the scan",
                        "give poses that map points of the scan to the world", inverted(trajectory)});
  candidates.push_back({"left_handed", "one of poses and points looks left-handed, the other right-handed",
                        "negate y of one of them (of poses: S T S with S = diag(1, -1, 1, 1)); where both are "
                        "left-handed, give --left-handed",
                        with_y_negated(trajectory)});
  return candidates;
}

/// What decides between candidates.
struct Fit {
  double scans_per_neighborhood = 0;
  double plane_variance_m2 = 0;
};

std::optional<Fit> fit_of(const SomeScans& scans, const Trajectory& trajectory, double radius_m,
                          const Execution& execution) {
  constexpr std::size_t kMapPoints = 120'000;
  constexpr std::size_t kQueries = 2'000;
  const MapSettings settings{.keep_every = std::max<std::size_t>(1, scans.num_points() / kMapPoints)};
  const RegisteredMap map = assemble_map(scans, trajectory, settings, execution).map;
  std::vector<Eigen::Vector3d> queries;
  const std::size_t every = std::max<std::size_t>(1, map.points_in_map.size() / kQueries);
  for (std::size_t i = 0; i < map.points_in_map.size(); i += every) queries.push_back(map.points_in_map[i]);
  const PointStatistics statistics =
      point_statistics(PointIndex(map), queries, {.radius_m = radius_m}, Definition::kPaper, execution);
  const Overlap overlapping = overlap(statistics);
  if (!overlapping.scans_per_neighborhood_mean) return std::nullopt;
  return Fit{*overlapping.scans_per_neighborhood_mean, *mpv(statistics).value};
}

bool clearly_better(const Fit& candidate, const Fit& given) {
  const double ratio = candidate.scans_per_neighborhood / given.scans_per_neighborhood;
  const bool thinner = candidate.plane_variance_m2 <= given.plane_variance_m2;
  const bool much_thinner = candidate.plane_variance_m2 <= 0.5 * given.plane_variance_m2;
  return ratio >= 2 || (ratio >= 1.2 && thinner) || (ratio >= 1 && much_thinner);
}

}  // namespace

std::optional<FrameMistake> find_frame_mistake(const ScanSequence& scans, const Trajectory& trajectory,
                                               const std::optional<Pose>& body_from_sensor, double radius_m,
                                               const Execution& execution) {
  if (scans.size() < 3) return std::nullopt;
  const Execution silent{.num_threads = execution.num_threads};
  const std::vector<std::size_t> chosen = middle_scans(scans.size());
  const SomeScans some_scans(scans, chosen);
  Trajectory some_poses;
  for (const std::size_t index : chosen) some_poses.world_from_scan.push_back(trajectory.world_from_scan[index]);

  const std::optional<Fit> given = fit_of(some_scans, some_poses, radius_m, silent);
  if (!given) return std::nullopt;
  std::optional<FrameMistake> found;
  Fit best = *given;
  for (const Candidate& candidate : likely_corrections(some_poses, body_from_sensor)) {
    const std::optional<Fit> fit = fit_of(some_scans, candidate.trajectory, radius_m, silent);
    if (!fit || !clearly_better(*fit, *given) || fit->scans_per_neighborhood <= best.scans_per_neighborhood) continue;
    best = *fit;
    found = FrameMistake{.code = candidate.code,
                         .mistake = candidate.mistake,
                         .remedy = candidate.remedy,
                         .scans_given = given->scans_per_neighborhood,
                         .scans_corrected = fit->scans_per_neighborhood,
                         .num_scans = some_scans.size()};
  }
  return found;
}

std::optional<Diagnostic> check_frames(const ScanSequence& scans, const Trajectory& trajectory,
                                       const std::optional<Pose>& body_from_sensor, double radius_m,
                                       const Execution& execution) {
  const std::optional<FrameMistake> found =
      find_frame_mistake(scans, trajectory, body_from_sensor, radius_m, execution);
  if (!found) return std::nullopt;
  return Diagnostic{found->code, fmt::format("{}: with that corrected a neighborhood holds {:.1f} of {} scans on "
                                             "average, as given {:.1f}; {}",
                                             found->mistake, found->scans_corrected, found->num_scans,
                                             found->scans_given, found->remedy)};
}

}  // namespace trysquare
