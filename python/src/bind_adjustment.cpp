// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/rpe_estimate.h"
#include "trysquare/report/evaluation_json.h"

#include "arrays.h"
#include "bind.h"
#include "scans.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

#include <string>
#include <utility>

namespace trysquare::python {
namespace {

using namespace nb::literals;

/// Adjusted poses, None where the estimate is refused, and the JSON of an evaluation that holds the estimate alone.
std::pair<std::optional<Poses>, std::string> refine(const ScanSequence& scans, const PoseArray& poses,
                                                    const AdjustmentSettings& settings, int threads,
                                                    std::optional<ProgressCallable> progress) {
  const Trajectory trajectory = trajectory_of(poses);
  const Execution execution = execution_of(threads, std::move(progress));
  Evaluation evaluation;
  {
    const nb::gil_scoped_release release;
    evaluation.rpe_estimate = estimate_rpe(scans, trajectory, settings, execution);
  }
  const Trajectory& adjusted = evaluation.rpe_estimate->adjusted;
  std::optional<Poses> result;
  if (evaluation.rpe_estimate->status != EstimateStatus::kRefused) result = poses_of(adjusted);
  return {std::move(result), to_json(evaluation, {.version = TRYSQUARE_VERSION, .scans = "numpy arrays"})};
}

}  // namespace

void bind_adjustment(nb::module_& module) {
  module.def("refine", &refine, "scans"_a, "poses"_a, "settings"_a, "threads"_a, "progress"_a.none());
}

}  // namespace trysquare::python
