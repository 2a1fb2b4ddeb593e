// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/report/trajectory_json.h"
#include "trysquare/synthetic/perturb.h"
#include "trysquare/trajectory/ape.h"
#include "trysquare/trajectory/association.h"
#include "trysquare/trajectory/axes_check.h"
#include "trysquare/trajectory/kitti_drift.h"
#include "trysquare/trajectory/paper_rpe.h"
#include "trysquare/trajectory/rpe.h"

#include "arrays.h"
#include "bind.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace trysquare::python {
namespace {

using namespace nb::literals;

/// Errors and their JSON, as the command prints it; `reason` says why there are none.
struct ComparedPoses {
  TrajectoryErrors errors;
  std::string json;
};

/// What both verbs are told.
struct ErrorOptions {
  PoseRelation relation = ApeSettings{}.relation;
  Alignment alignment = ApeSettings{}.alignment;
  std::size_t num_poses_to_align = 0;
  std::optional<Plane> projection;
  AssociationSettings association;
};

ErrorOptions options_of(const std::string& relation, const std::string& alignment, std::size_t num_poses_to_align,
                        const std::optional<std::string>& plane, const AssociationSettings& association) {
  ErrorOptions options{.num_poses_to_align = num_poses_to_align, .projection = {}, .association = association};
  const auto known_relation = pose_relation_named(relation);
  if (!known_relation) {
    throw InvalidArgument("relation = '" + relation +
                          "' is not known: expected full, trans_part, rot_part, angle_deg, angle_rad, point_distance, "
                          "point_distance_error_ratio");
  }
  const auto known_alignment = alignment_named(alignment);
  if (!known_alignment) {
    throw InvalidArgument("align = '" + alignment + "' is not known: expected none, origin, scale, se3, sim3");
  }
  if (plane) {
    options.projection = plane_named(*plane);
    if (!options.projection) throw InvalidArgument("plane = '" + *plane + "' is not known: expected xy, xz, yz");
  }
  options.relation = *known_relation;
  options.alignment = *known_alignment;
  return options;
}

TrajectoryErrorsFacts facts_of(const AssociatedTrajectories& poses, const AssociationSettings& association) {
  TrajectoryErrorsFacts facts{.version = TRYSQUARE_VERSION,
                              .reference = "numpy array",
                              .estimate = "numpy array",
                              .num_associated = poses.num_pairs,
                              .num_unmatched_reference = poses.num_unmatched_reference,
                              .num_unmatched_estimate = poses.num_unmatched_estimate,
                              .num_extrapolated = poses.num_extrapolated,
                              .median_time_difference_s = poses.median_difference_s,
                              .preparation = {.association = association},
                              .quantiles = {0.5, 0.75, 0.9, 0.95, 0.99}};
  if (const auto finding = check_axes(poses.reference, poses.estimate)) facts.warnings.push_back(*finding);
  return facts;
}

template <class Settings, class ToJson>
ComparedPoses errors_of(const Trajectory& reference, const Trajectory& estimate, const Settings& settings,
                        const AssociationSettings& association,
                        TrajectoryErrors (*compute)(const Trajectory&, const Trajectory&, const Settings&),
                        const ToJson& json_of) {
  const nb::gil_scoped_release release;
  const AssociatedTrajectories poses = associate(reference, estimate, association);
  TrajectoryErrorsFacts facts = facts_of(poses, association);
  ComparedPoses result{.errors = {.relation = settings.relation}, .json = {}};
  try {
    result.errors = compute(poses.reference, poses.estimate, settings);
  } catch (const InvalidArgument& error) {
    facts.reason = error.what();  // no value exists, such as that of the alignment of a straight line
  }
  result.json = json_of(result.errors, facts, poses);
  return result;
}

ComparedPoses ape_of(const PoseArray& reference, const std::optional<StampArray>& reference_stamps_ns,
                     const PoseArray& estimate, const std::optional<StampArray>& estimate_stamps_ns,
                     const std::string& relation, const std::string& alignment, std::size_t num_poses_to_align,
                     const std::optional<std::string>& plane, const AssociationSettings& association) {
  const ErrorOptions options = options_of(relation, alignment, num_poses_to_align, plane, association);
  if (options.relation == PoseRelation::kPointDistanceErrorRatio) {
    throw InvalidArgument("relation = 'point_distance_error_ratio' is for rpe: absolute errors have no such ratio");
  }
  const ApeSettings settings{.relation = options.relation,
                             .alignment = options.alignment,
                             .num_poses_to_align = options.num_poses_to_align,
                             .projection = options.projection};
  return errors_of(trajectory_of(reference, reference_stamps_ns), trajectory_of(estimate, estimate_stamps_ns), settings,
                   association, ape,
                   [&](const TrajectoryErrors& errors, const TrajectoryErrorsFacts& facts,
                       const AssociatedTrajectories&) { return to_json(errors, settings, facts); });
}

ComparedPoses rpe_of(const PoseArray& reference, const std::optional<StampArray>& reference_stamps_ns,
                     const PoseArray& estimate, const std::optional<StampArray>& estimate_stamps_ns,
                     const std::string& relation, const std::string& alignment, std::size_t num_poses_to_align,
                     const std::optional<std::string>& plane, const AssociationSettings& association,
                     const PosePairSettings& pairs, bool pairs_from_reference, bool kitti, bool every_pair,
                     int threads) {
  const ErrorOptions options = options_of(relation, alignment, num_poses_to_align, plane, association);
  pairs.validate();
  const RpeSettings settings{.relation = options.relation,
                             .pairs = pairs,
                             .pairs_from_reference = pairs_from_reference,
                             .alignment = options.alignment,
                             .num_poses_to_align = options.num_poses_to_align,
                             .projection = options.projection};
  return errors_of(
      trajectory_of(reference, reference_stamps_ns), trajectory_of(estimate, estimate_stamps_ns), settings, association,
      rpe,
      [&](const TrajectoryErrors& errors, const TrajectoryErrorsFacts& facts, const AssociatedTrajectories& poses) {
        RelativeErrors others;
        if (kitti) others.kitti_drift = kitti_drift(poses.reference, poses.estimate);
        if (every_pair) {
          others.every_pair = all_pairs_rpe(poses.reference, poses.estimate, {.num_threads = threads});
          others.paper_rpe_m2 = paper_rpe(poses.reference, poses.estimate);
        }
        return to_json(errors, settings, facts, others);
      });
}

/// Which stamp is nearest to each query, as numpy has no optional: -1 where none is near enough.
Values<std::int64_t> nearest_indices(const StampArray& queries_ns, const StampArray& stamps_ns, double t_max_diff_s) {
  const auto found =
      nearest_in_time({queries_ns.data(), queries_ns.size()}, {stamps_ns.data(), stamps_ns.size()}, t_max_diff_s);
  std::vector<std::int64_t> indices;
  for (const std::optional<std::size_t>& each : found) {
    indices.push_back(each ? static_cast<std::int64_t>(*each) : -1);
  }
  return array_of(std::move(indices));
}

Poses perturbed(const PoseArray& poses, double translation_m, double rotation_deg, const std::string& model,
                std::uint64_t seed) {
  const auto noise = noise_model_named(model);
  if (!noise) throw InvalidArgument("model = '" + model + "' is not known: expected white, walk");
  const PerturbationSettings settings{.translation_sigma_m = translation_m,
                                      .rotation_sigma_rad = rotation_deg * std::numbers::pi / 180,
                                      .seed = seed,
                                      .model = *noise};
  settings.validate();
  Trajectory trajectory = trajectory_of(poses);
  {
    const nb::gil_scoped_release release;
    trajectory = perturb(trajectory, settings);
  }
  return poses_of(trajectory);
}

}  // namespace

void bind_trajectory(nb::module_& module) {
  nb::class_<ComparedPoses>(module, "ComparedPoses")
      .def_ro("json", &ComparedPoses::json)
      .def_prop_ro(
          "errors", [](const ComparedPoses& compared) { return array_of(compared.errors.errors); }, kOwnValues)
      .def_prop_ro(
          "pairs",
          [](const ComparedPoses& compared) {
            std::vector<std::int64_t> flat;
            for (const PosePair& pair : compared.errors.pairs) {
              flat.push_back(static_cast<std::int64_t>(pair.first));
              flat.push_back(static_cast<std::int64_t>(pair.second));
            }
            return array_of(std::move(flat));
          },
          kOwnValues);
  module.def("ape", &ape_of, "reference"_a, "reference_stamps_ns"_a.none(), "estimate"_a, "estimate_stamps_ns"_a.none(),
             "relation"_a, "align"_a, "num_poses_to_align"_a, "plane"_a.none(), "association"_a);
  module.def("rpe", &rpe_of, "reference"_a, "reference_stamps_ns"_a.none(), "estimate"_a, "estimate_stamps_ns"_a.none(),
             "relation"_a, "align"_a, "num_poses_to_align"_a, "plane"_a.none(), "association"_a, "pairs"_a,
             "pairs_from_reference"_a, "kitti"_a, "every_pair"_a, "threads"_a);
  module.def("nearest_in_time", &nearest_indices, "queries_ns"_a, "stamps_ns"_a, "t_max_diff_s"_a,
             "(Q,) index of the stamp nearest to each query; -1: none is within t_max_diff_s.");
  module.def("perturb", &perturbed, "poses"_a, "translation_m"_a, "rotation_deg"_a, "model"_a, "seed"_a);
}

}  // namespace trysquare::python
