// SPDX-License-Identifier: Apache-2.0
#include "trysquare/adjustment/adjustment_settings.h"
#include "trysquare/core/error.h"
#include "trysquare/pipeline/compare.h"
#include "trysquare/pipeline/diagnosis.h"
#include "trysquare/pipeline/evaluation_settings.h"
#include "trysquare/trajectory/association.h"
#include "trysquare/trajectory/pose_pairs.h"

#include "bind.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <vector>

// Settings are the structs of the library, so that a default has one home. Python sets what the caller gives.
namespace trysquare::python {
namespace {

using namespace nb::literals;

std::vector<std::string> metric_names(const EvaluationSettings& settings) {
  std::vector<std::string> names;
  for (const Metric metric : settings.metrics) names.emplace_back(name_of(metric));
  return names;
}

/// What a name stands for.
template <class T>
T known(std::optional<T> value, const char* argument, const std::string& name, const char* names) {
  if (value) return *value;
  throw InvalidArgument(std::string(argument) + " = '" + name + "' is not known: expected " + names);
}

void set_metrics(EvaluationSettings& settings, const std::vector<std::string>& names) {
  settings.metrics.clear();
  for (const std::string& name : names) {
    settings.metrics.push_back(known(metric_named(name), "metrics", name, "mme, mpv, omme, mom, rpe"));
  }
}

void bind_evaluation_settings(nb::module_& module) {
  nb::class_<EvaluationSettings>(module, "EvaluationSettings")
      .def(nb::init<>())
      .def_static("room_scale", &EvaluationSettings::room_scale)
      .def_prop_rw("metrics", metric_names, set_metrics)
      .def_prop_rw(
          "definition", [](const EvaluationSettings& s) { return std::string(name_of(s.definition)); },
          [](EvaluationSettings& s, const std::string& name) {
            s.definition = known(definition_named(name), "definition", name, "paper, map-metrics, mapeval, ais-bonn");
          })
      .def_rw("radius_m", &EvaluationSettings::radius_m)
      .def_rw("min_neighbors", &EvaluationSettings::min_neighbors)
      .def_rw("min_neighbors_orthogonal", &EvaluationSettings::min_neighbors_orthogonal)
      .def_rw("query_every", &EvaluationSettings::query_every)
      .def_rw("min_range_m", &EvaluationSettings::min_range_m)
      .def_rw("max_range_m", &EvaluationSettings::max_range_m)
      .def_rw("window", &EvaluationSettings::window)
      .def_rw("stride", &EvaluationSettings::stride)
      .def_rw("adjustment", &EvaluationSettings::adjustment)
      .def_prop_rw(
          "subset_method", [](const EvaluationSettings& s) { return std::string(name_of(s.orthogonal.method)); },
          [](EvaluationSettings& s, const std::string& name) {
            s.orthogonal.method =
                known(subset_method_named(name), "subset_method", name, "patches, paper, map-metrics");
          })
      .def_prop_rw(
          "subset_scans", [](const EvaluationSettings& s) { return s.orthogonal.num_scans; },
          [](EvaluationSettings& s, std::optional<std::size_t> count) {
            if (count == 0U) throw InvalidArgument("subset_scans = 0 is out of range: it must be at least 1");
            s.orthogonal.num_scans = count;
          })
      .def_prop_rw(
          "join_colinear", [](const EvaluationSettings& s) { return s.orthogonal.join_colinear; },
          [](EvaluationSettings& s, bool join) { s.orthogonal.join_colinear = join; })
      .def("validate", &EvaluationSettings::validate);
}

void bind_adjustment_settings(nb::module_& module) {
  nb::class_<AdjustmentSettings>(module, "AdjustmentSettings")
      .def(nb::init<>())
      .def_static("room_scale", &AdjustmentSettings::room_scale)
      .def_rw("min_range_m", &AdjustmentSettings::min_range_m)
      .def_rw("max_range_m", &AdjustmentSettings::max_range_m)
      .def("validate", &AdjustmentSettings::validate);
}

}  // namespace

void bind_settings(nb::module_& module) {
  bind_adjustment_settings(module);
  bind_evaluation_settings(module);
  nb::class_<ComparisonSettings>(module, "ComparisonSettings")
      .def(nb::init<>())
      .def_rw("evaluation", &ComparisonSettings::evaluation)
      .def_rw("confidence", &ComparisonSettings::confidence);
  nb::class_<DiagnosisSettings>(module, "DiagnosisSettings")
      .def(nb::init<>())
      .def_rw("radius_m", &DiagnosisSettings::radius_m)
      .def_rw("max_time_offset_s", &DiagnosisSettings::max_time_offset_s)
      .def_rw("adjustment", &DiagnosisSettings::adjustment);
  nb::class_<AssociationSettings>(module, "AssociationSettings")
      .def(nb::init<>())
      .def_rw("max_difference_s", &AssociationSettings::max_difference_s)
      .def_rw("offset_s", &AssociationSettings::offset_s)
      .def_rw("one_to_one", &AssociationSettings::one_to_one)
      .def_rw("interpolate", &AssociationSettings::interpolate);
  nb::class_<PosePairSettings>(module, "PosePairSettings")
      .def(nb::init<>())
      .def_rw("delta", &PosePairSettings::delta)
      .def_prop_rw(
          "delta_unit", [](const PosePairSettings& s) { return std::string(name_of(s.unit)); },
          [](PosePairSettings& s, const std::string& name) {
            s.unit = known(delta_unit_named(name), "delta_unit", name, "f, m, d, r");
          })
      .def_rw("delta_tol", &PosePairSettings::relative_tolerance)
      .def_rw("all_pairs", &PosePairSettings::all_pairs);
}

}  // namespace trysquare::python
