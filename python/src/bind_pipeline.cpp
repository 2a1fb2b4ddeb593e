// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/measured_points.h"
#include "trysquare/pipeline/compare.h"
#include "trysquare/pipeline/diagnosis.h"
#include "trysquare/pipeline/evaluate.h"
#include "trysquare/report/comparison_json.h"
#include "trysquare/report/diagnosis_json.h"
#include "trysquare/report/evaluation_json.h"

#include "arrays.h"
#include "bind.h"
#include "scans.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

namespace trysquare::python {
namespace {

using namespace nb::literals;

/// What the command says of files that are numpy arrays here.
constexpr const char* kArrays = "numpy arrays";

/// Where the inputs of a call came from.
struct InputFacts {
  std::string scans = kArrays;
  std::optional<std::string> poses = kArrays;
  std::optional<std::string> poses_format;
  std::optional<std::string> extrinsic_source;
  std::optional<std::string> reference;
  std::optional<std::string> reference_extrinsic;
  std::optional<std::string> subset;
  bool left_handed = false;
  std::vector<std::pair<std::string, std::string>> warnings;

  EvaluationFacts of_evaluation() const {
    return {.version = TRYSQUARE_VERSION,
            .scans = scans,
            .poses = poses,
            .left_handed = left_handed,
            .poses_format = poses_format,
            .extrinsic = extrinsic_source,
            .reference = reference,
            .reference_extrinsic = reference_extrinsic,
            .subset = subset,
            .wall_time_s = {}};
  }
};

/// An evaluation with its JSON, as the command prints it.
struct NativeEvaluation {
  Evaluation evaluation;
  std::string json;
};

NativeEvaluation with_json(Evaluation evaluation, const InputFacts& facts) {
  std::vector<Diagnostic> warnings;
  for (const auto& [code, message] : facts.warnings) warnings.push_back({code, message});
  evaluation.warnings.insert(evaluation.warnings.begin(), warnings.begin(), warnings.end());
  std::string json = to_json(evaluation, facts.of_evaluation());
  return {std::move(evaluation), std::move(json)};
}

NativeEvaluation evaluate_scans(const ScanSequence& scans, const PoseArray& poses, const EvaluationSettings& settings,
                                const std::optional<std::vector<PointArray>>& subset,
                                const std::optional<PoseArray>& reference, const std::optional<MatrixArray>& extrinsic,
                                const InputFacts& facts, int threads, std::optional<ProgressCallable> progress) {
  const Trajectory trajectory = trajectory_of(poses);
  EvaluationContext context;
  if (subset) context.subset = subset_of(*subset);
  if (reference) context.reference = trajectory_of(*reference);
  if (extrinsic) context.body_from_sensor = pose_of(*extrinsic);
  const Execution execution = execution_of(threads, std::move(progress));
  const nb::gil_scoped_release release;
  return with_json(evaluate(scans, trajectory, settings, context, execution), facts);
}

NativeEvaluation evaluate_points(const PointArray& points, const EvaluationSettings& settings,
                                 const std::optional<std::vector<PointArray>>& subset, const InputFacts& facts,
                                 int threads, std::optional<ProgressCallable> progress) {
  EvaluationContext context;
  if (subset) context.subset = subset_of(*subset);
  const Execution execution = execution_of(threads, std::move(progress));
  const PointsView view = view_of(points);
  const nb::gil_scoped_release release;
  return with_json(evaluate_map(map_of_measured({view.begin(), view.end()}), settings, context, execution), facts);
}

using Self = nb::handle_t<NativeEvaluation>;

const Evaluation& evaluation_of(Self self) { return nb::cast<NativeEvaluation&>(self).evaluation; }

std::vector<Points> subset_arrays(Self self) {
  std::vector<Points> arrays;
  for (const auto& direction : evaluation_of(self).subset.directions) {
    arrays.push_back(view_of(direction.points_in_map, self));
  }
  return arrays;
}

void bind_evaluation(nb::module_& module) {
  nb::class_<InputFacts>(module, "InputFacts")
      .def(nb::init<>())
      .def_rw("scans", &InputFacts::scans)
      .def_rw("poses", &InputFacts::poses)
      .def_rw("poses_format", &InputFacts::poses_format)
      .def_rw("extrinsic_source", &InputFacts::extrinsic_source)
      .def_rw("reference", &InputFacts::reference)
      .def_rw("reference_extrinsic", &InputFacts::reference_extrinsic)
      .def_rw("subset", &InputFacts::subset)
      .def_rw("left_handed", &InputFacts::left_handed)
      .def_rw("warnings", &InputFacts::warnings);
  nb::class_<NativeEvaluation>(module, "NativeEvaluation")
      .def_ro("json", &NativeEvaluation::json)
      .def_prop_ro("points_in_map", [](Self self) { return view_of(evaluation_of(self).map.points_in_map, self); })
      .def_prop_ro("scan_of_point", [](Self self) { return view_of(evaluation_of(self).map.scan_of_point, self); })
      .def_prop_ro("query_indices", [](Self self) { return view_of(evaluation_of(self).query_indices, self); })
      .def_prop_ro("plane_variances",
                   [](Self self) { return view_of(evaluation_of(self).query_statistics.plane_variances, self); })
      .def_prop_ro("entropies", [](Self self) { return view_of(evaluation_of(self).query_statistics.entropies, self); })
      .def_prop_ro("num_neighbors",
                   [](Self self) { return view_of(evaluation_of(self).query_statistics.num_neighbors, self); })
      .def_prop_ro("num_scans", [](Self self) { return view_of(evaluation_of(self).query_statistics.num_scans, self); })
      .def_prop_ro("subset", subset_arrays)
      .def_prop_ro(
          "adjusted",
          [](const NativeEvaluation& native) -> std::optional<Poses> {
            const auto& estimate = native.evaluation.rpe_estimate;
            if (!estimate || estimate->adjusted.size() == 0) return std::nullopt;
            return poses_of(estimate->adjusted);
          },
          kOwnValues);
  module.def("evaluate", &evaluate_scans, "scans"_a, "poses"_a, "settings"_a, "subset"_a.none(), "reference"_a.none(),
             "extrinsic"_a.none(), "facts"_a, "threads"_a, "progress"_a.none());
  module.def("evaluate_map", &evaluate_points, "points"_a, "settings"_a, "subset"_a.none(), "facts"_a, "threads"_a,
             "progress"_a.none());
}

/// The JSON of a comparison, and its windows as CSV.
std::pair<std::string, std::string> compare_scans(const ScanSequence& scans, const std::vector<std::string>& names,
                                                  const std::vector<PoseArray>& poses,
                                                  const ComparisonSettings& settings, const std::string& scans_name,
                                                  int threads, std::optional<ProgressCallable> progress) {
  std::vector<Candidate> candidates;
  ComparisonFacts facts{.version = TRYSQUARE_VERSION, .scans = scans_name};
  for (std::size_t i = 0; i < names.size(); ++i) {
    candidates.push_back({.name = names[i], .world_from_scan = trajectory_of(poses.at(i)), .body_from_sensor = {}});
    facts.sources.push_back({.poses = kArrays, .poses_format = "matrix", .extrinsic = {}});
  }
  const Execution execution = execution_of(threads, std::move(progress));
  const nb::gil_scoped_release release;
  const Comparison comparison = compare(scans, candidates, settings, execution);
  return {to_json(comparison, facts), windows_csv(comparison)};
}

std::string diagnose_scans(const ScanSequence& scans, const PoseArray& poses, const DiagnosisSettings& settings,
                           const std::optional<PoseArray>& all_poses, const std::optional<StampArray>& all_stamps_ns,
                           const std::optional<MatrixArray>& extrinsic, const InputFacts& facts, int threads,
                           std::optional<ProgressCallable> progress) {
  const Trajectory trajectory = trajectory_of(poses);
  DiagnosisContext context;
  if (all_poses) context.all_poses = trajectory_of(*all_poses, all_stamps_ns);
  if (extrinsic) context.body_from_sensor = pose_of(*extrinsic);
  const Execution execution = execution_of(threads, std::move(progress));
  const nb::gil_scoped_release release;
  return to_json(diagnose(scans, trajectory, settings, context, execution), settings,
                 {.version = TRYSQUARE_VERSION,
                  .scans = facts.scans,
                  .poses = facts.poses.value_or(kArrays),
                  .poses_format = facts.poses_format.value_or("matrix"),
                  .left_handed = facts.left_handed,
                  .extrinsic = facts.extrinsic_source});
}

}  // namespace

void bind_pipeline(nb::module_& module) {
  bind_evaluation(module);
  module.def("compare", &compare_scans, "scans"_a, "names"_a, "poses"_a, "settings"_a, "scans_name"_a, "threads"_a,
             "progress"_a.none());
  module.def("diagnose", &diagnose_scans, "scans"_a, "poses"_a, "settings"_a, "all_poses"_a.none(),
             "all_stamps_ns"_a.none(), "extrinsic"_a.none(), "facts"_a, "threads"_a, "progress"_a.none());
}

}  // namespace trysquare::python
