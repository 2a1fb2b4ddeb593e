// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/adjustment/between_scan_variance.h"
#include "trysquare/adjustment/suspect_poses.h"
#include "trysquare/core/execution.h"
#include "trysquare/core/scan.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/trajectory/pose_pairs.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare {

// Limits of the rules that decide what an estimate is worth: docs/definitions.md#rpe-estimate.
/// Fewer poses have no check of themselves.
inline constexpr std::size_t kFewestPosesOfEstimate = 3;
/// Inlier patches that every pose needs.
inline constexpr std::size_t kFewestObservations = 30;
/// Of the mean n nᵀ of the inlier observations: below, some direction is not determined.
inline constexpr double kLeastEigenvalue = 0.015;
/// Below this eigenvalue the weak direction is named.
inline constexpr double kWeakEigenvalue = 0.03;

/// What an estimate of the RPE is worth.
enum class EstimateStatus {
  kMeasured,  ///< The estimate holds within its interval.
  kBound,     ///< Too small to measure: the RPE is at most upper_bound_m.
  kRefused    ///< There is no estimate; the reasons say which rule failed, and by how much.
};

/// "measured", "bound", "refused".
std::string_view name_of(EstimateStatus status);

/// The RPE of some pairs of poses. It has a status of its own, by the difference of the halves over these pairs: drift
/// may be too slow to measure between far poses and yet small between near ones.
struct PairRpe {
  PosePairSettings pairs;     ///< Which pairs, chosen on the given poses.
  std::size_t num_pairs = 0;  ///< 0: no pair is that far apart, and there is no estimate.
  EstimateStatus status = EstimateStatus::kRefused;
  std::optional<double> translation_rms_m{};  ///< Root mean square, noise removed; empty when refused. So for all.
  std::optional<double> rotation_rms_rad{};
  std::optional<std::array<double, 2>> interval_m{};  ///< Only when measured.
  std::optional<double> upper_bound_m{};              ///< Only for a bound.
  std::optional<double> half_difference_m{};          ///< Between the halves, over these pairs; also when refused.
  std::optional<double> half_difference_rad{};
};

/// One pose as the estimate sees it.
struct EstimatedPose {
  PoseDeviation deviation;  ///< Beyond what the poses around it share.
  double sigma_m = 0;       ///< Of its translation relative to pose 0: root of the trace of the covariance.
  double sigma_rad = 0;
  std::size_t num_observations = 0;  ///< Patches that it was measured on, outliers left out.
};

/// How well poses near each other hold each other: the smallest eigenvalue, but those of their common motion, of
/// Σ n nᵀ (δ_ij − 1/m) over the inlier patches that m of these poses share, by the mean count of a pose. Where all see
/// the same it is that of the mean n nᵀ.
struct PoseTie {
  double eigenvalue = 0;
  double limit = 0;  ///< Groups of the poses slide past each other where the eigenvalue is below.
  std::size_t first_pose = 0;
  std::size_t last_pose = 0;                                   ///< Inclusive.
  Eigen::Vector3d direction_in_map = Eigen::Vector3d::Zero();  ///< Along which they slide.
};

/// Trajectory error without ground truth: the relative pose error (RPE) of a trajectory against the one in which its
/// own scans agree on their planes. Lower is better; metres and radians.
struct RpeEstimate {
  EstimateStatus status = EstimateStatus::kRefused;
  std::vector<std::string> reasons;  ///< Why it is not measured; empty when it is.

  std::optional<double> translation_rms_m;  ///< All pairs; empty when refused. So for all optional results.
  std::optional<double> rotation_rms_rad;
  std::optional<std::array<double, 2>> interval_m;    ///< Only when measured; see kIntervalCovers.
  std::optional<std::array<double, 2>> interval_rad;  ///< Likewise.
  std::optional<double> upper_bound_m;                ///< Only for a bound.
  std::optional<double> systematic_indicator_m;       ///< RPE between adjustments by near and by far patches alone.
  std::string systematic_reason;                      ///< Why that is empty.
  double pair_sigma_m = 0;    ///< Root of the mean variance over all pairs, removed from the estimate; 0 when refused.
  double pair_sigma_rad = 0;  ///< Likewise.
  std::vector<PairRpe> by_pairs;      ///< Consecutive, 10 frames, 10 m; empty when refused by more than the halves.
  std::vector<EstimatedPose> poses;   ///< N, empty when refused.
  Trajectory adjusted;                ///< N poses, world_from_scan; pose 0 as given. Empty when refused.
  BetweenScanVariance between_scans;  ///< MOM without its noise, at the poses as given.

  // What the rules look at. Printed whatever the status.
  std::size_t num_patches = 0;
  std::size_t observations_per_pose_min = 0;  ///< Inliers.
  std::optional<double>
      least_share_of_neighbors;    ///< Smallest inlier count of a pose over the median around it; empty likewise.
  std::size_t num_components = 0;  ///< Groups of scans that share patches; 1: connected.
  std::size_t num_iterations = 0;
  double last_step_m = 0;
  double last_step_rad = 0;
  double smallest_eigenvalue = 0;                        ///< Of the mean n nᵀ of the inlier observations.
  std::optional<Eigen::Vector3d> weak_direction_in_map;  ///< Where hardly any plane faces; empty: none is weak.
  std::optional<PoseTie>
      weakest_tie;  ///< Of the runs of six poses in a row or more; empty: no pose agrees with a patch.
  std::optional<double> half_difference_m;  ///< RPE between adjustments by two halves of the patches; empty: none.
  std::optional<double> half_difference_rad;
  double within_scan_sigma_m = 0;  ///< Median noise of points about a patch within one scan.
};

/// What the interval means, for reports.
inline constexpr std::string_view kIntervalCovers =
    "the RPE against the trajectory in which the scans agree on their planes; not what the sensor itself bends "
    "(systematic_indicator_m)";

/// Up to this difference between its halves [m] an estimate is at least a bound: max(2 cm, 1.5 within_scan_sigma_m).
double half_difference_limit_m(const RpeEstimate& estimate);

/// How far the interval of an accepted estimate reaches to either side of it [m]: max(1.5 pair_sigma_m, half / 2), or
/// the whole half_difference_m for a bound. Holds for the RPE of any trajectory against the same adjusted poses: the
/// error of a root mean square is at most the root mean square of the errors.
///
/// @throws InvalidArgument  for a refused estimate.
/// Source: docs/definitions.md#rpe-estimate (interval).
double interval_reach_m(const RpeEstimate& estimate);

/// Estimates the RPE of a trajectory from its scans alone, and says when it cannot.
///
/// Planar patches of some scans are measured in every scan that sees them; a robust least squares finds the poses in
/// which all agree (adjust_poses.h). The estimate is the RPE between the given and those poses, all pairs, less the
/// noise of the adjustment. The same is done with two halves of the patches; seven rules decide between measured, bound
/// and refused.
///
/// @param scans       N scans, loaded once or, beyond max_points_in_memory, once per iteration.
/// @param trajectory  N poses, world_from_scan; right to about a metre.
/// @return            A refusal is a result, not an error.
/// @throws InvalidArgument  if a setting is out of range, the counts differ, or a pose is not finite or no rotation.
/// @throws IoError          from ScanSequence::load().
///
/// Properties (rpe_estimate_test.cpp):
///   (1) the same for every number of threads, to the bit
///   (2) the same in every world frame, UTM included, up to rounding
///
/// Source: docs/definitions.md#rpe-estimate. Goes beyond the paper.
RpeEstimate estimate_rpe(const ScanSequence& scans, const Trajectory& trajectory,
                         const AdjustmentSettings& settings = {}, const Execution& execution = {});

}  // namespace trysquare
