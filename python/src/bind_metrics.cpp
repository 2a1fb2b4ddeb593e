// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/some_scans.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/metrics/mme.h"
#include "trysquare/metrics/mom.h"
#include "trysquare/metrics/mpv.h"
#include "trysquare/metrics/omme.h"
#include "trysquare/pipeline/evaluation_settings.h"
#include "trysquare/report/orthogonal_json.h"

#include "arrays.h"
#include "bind.h"
#include "scans.h"
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

namespace trysquare::python {
namespace {

using namespace nb::literals;

NeighborhoodSettings neighborhoods(const EvaluationSettings& settings, int min_neighbors) {
  return {.radius_m = settings.radius_m, .min_neighbors = min_neighbors};
}

PointStatistics statistics_of(const PointArray& points, const std::optional<PointArray>& queries,
                              const EvaluationSettings& settings, int threads) {
  const PointsView map = view_of(points);
  const PointsView asked = queries ? view_of(*queries) : map;
  const nb::gil_scoped_release release;
  settings.validate();
  const Execution execution{.num_threads = threads, .progress = {}};
  return point_statistics(PointIndex(map, execution), asked, neighborhoods(settings, settings.min_neighbors),
                          settings.definition, execution);
}

OrthogonalStatistics orthogonal_statistics_of(const PointArray& points, const std::vector<PointArray>& directions,
                                              const EvaluationSettings& settings, int threads) {
  const PointsView map = view_of(points);
  const OrthogonalSubset subset = subset_of(directions);
  const nb::gil_scoped_release release;
  settings.validate();
  const Execution execution{.num_threads = threads, .progress = {}};
  return orthogonal_statistics(PointIndex(map, execution), subset,
                               neighborhoods(settings, settings.min_neighbors_orthogonal), execution);
}

void bind_results(nb::module_& module) {
  nb::class_<MetricResult>(module, "MetricResult")
      .def_ro("value", &MetricResult::value)
      .def_ro("reason", &MetricResult::reason)
      .def_ro("num_queries", &MetricResult::num_queries)
      .def_ro("num_used", &MetricResult::num_used)
      .def_ro("num_degenerate", &MetricResult::num_degenerate)
      .def_ro("num_too_few", &MetricResult::num_too_few);
  using Direction = OrthogonalMetricResult::Direction;
  nb::class_<Direction>(module, "MetricOfDirection")
      .def_ro("num_points", &Direction::num_points)
      .def_ro("num_used", &Direction::num_used)
      .def_ro("num_degenerate", &Direction::num_degenerate)
      .def_ro("num_too_few", &Direction::num_too_few)
      .def_ro("mean", &Direction::mean)
      .def_ro("median", &Direction::median);
  nb::class_<OrthogonalMetricResult>(module, "OrthogonalMetricResult")
      .def_ro("value", &OrthogonalMetricResult::value)
      .def_ro("reason", &OrthogonalMetricResult::reason)
      .def_ro("mean_of_means", &OrthogonalMetricResult::mean_of_means)
      .def_ro("sum_of_medians", &OrthogonalMetricResult::sum_of_medians)
      .def_ro("directions", &OrthogonalMetricResult::directions)
      .def_ro("follows_trajectory_error", &OrthogonalMetricResult::follows_trajectory_error);
}

void bind_statistics(nb::module_& module) {
  nb::class_<PointStatistics>(module, "PointStatistics", "Values of M query points, in their order.")
      .def_prop_ro("plane_variances",
                   [](nb::handle_t<PointStatistics> self) {
                     return view_of(nb::cast<PointStatistics&>(self).plane_variances, self);
                   })
      .def_prop_ro(
          "entropies",
          [](nb::handle_t<PointStatistics> self) { return view_of(nb::cast<PointStatistics&>(self).entropies, self); })
      .def_prop_ro("num_neighbors", [](nb::handle_t<PointStatistics> self) {
        return view_of(nb::cast<PointStatistics&>(self).num_neighbors, self);
      });
  nb::class_<OrthogonalStatistics>(module, "OrthogonalStatistics")
      .def("plane_variances", [](const OrthogonalStatistics& s,
                                 std::size_t i) { return array_of(s.directions.at(i).points.plane_variances); })
      .def("entropies",
           [](const OrthogonalStatistics& s, std::size_t i) { return array_of(s.directions.at(i).points.entropies); })
      .def("__len__", [](const OrthogonalStatistics& s) { return s.directions.size(); });
}

struct ExtractedSubset {
  OrthogonalSubsetResult result;
  std::string json;
};

/// Of the scans that the method looks at, not of all: a sequence can be too long for memory.
ExtractedSubset extract(const ScanSequence& scans, const PoseArray& poses, const EvaluationSettings& settings,
                        int threads, std::optional<ProgressCallable> progress, const std::string& scans_name,
                        const std::string& poses_name) {
  const Trajectory all = trajectory_of(poses);
  const Execution execution = execution_of(threads, std::move(progress));
  const nb::gil_scoped_release release;
  settings.validate();
  require_pose_per_scan(all, scans.size());
  const std::vector<std::uint32_t> looked_at = settings.orthogonal.scans_looked_at(scans.size());
  const std::vector<std::size_t> chosen(looked_at.begin(), looked_at.end());
  const MapSettings ranges{.min_range_m = settings.min_range_m, .max_range_m = settings.max_range_m};
  const RegisteredMap map = assemble_map(SomeScans(scans, chosen), take(all, chosen), ranges, execution).map;
  ExtractedSubset extracted{.result = extract_orthogonal_subset(map, settings.radius_m, settings.orthogonal, execution),
                            .json = {}};
  extracted.json = to_json(extracted.result, settings.orthogonal,
                           {.version = TRYSQUARE_VERSION,
                            .scans = scans_name,
                            .poses = poses_name,
                            .radius_m = settings.radius_m,
                            .num_scans = scans.size()});
  return extracted;
}

void bind_extraction(nb::module_& module) {
  nb::class_<ExtractedSubset>(module, "ExtractedSubset")
      .def_ro("json", &ExtractedSubset::json)
      .def_prop_ro("reason", [](const ExtractedSubset& s) { return s.result.reason; })
      .def_prop_ro("num_points", [](const ExtractedSubset& s) { return s.result.num_points; })
      .def_prop_ro("num_planar", [](const ExtractedSubset& s) { return s.result.num_planar; })
      .def("__len__", [](const ExtractedSubset& s) { return s.result.subset.directions.size(); })
      .def("points", [](const ExtractedSubset& s,
                        std::size_t i) { return array_of(s.result.subset.directions.at(i).points_in_map); })
      .def("normal", [](const ExtractedSubset& s, std::size_t i) {
        const Eigen::Vector3d& normal = s.result.subset.directions.at(i).normal_in_map;
        return array_of(std::vector<double>{normal.x(), normal.y(), normal.z()});
      });
  module.def("extract_orthogonal_subset", &extract, "scans"_a, "poses"_a, "settings"_a, "threads"_a,
             "progress"_a.none(), "scans_name"_a, "poses_name"_a);
}

}  // namespace

void bind_metrics(nb::module_& module) {
  bind_results(module);
  bind_statistics(module);
  bind_extraction(module);
  module.def("point_statistics", &statistics_of, "points"_a, "queries"_a.none(), "settings"_a, "threads"_a);
  module.def(
      "mme",
      [](const PointStatistics& points, const EvaluationSettings& settings) {
        return mme(points, settings.definition);
      },
      "statistics"_a, "settings"_a);
  module.def(
      "mpv", [](const PointStatistics& points, const EvaluationSettings&) { return mpv(points); }, "statistics"_a,
      "settings"_a);
  module.def("orthogonal_statistics", &orthogonal_statistics_of, "points"_a, "subset"_a, "settings"_a, "threads"_a);
  module.def(
      "mom",
      [](const OrthogonalStatistics& subset, const EvaluationSettings& settings) {
        return mom(subset, settings.definition);
      },
      "statistics"_a, "settings"_a);
  module.def(
      "omme",
      [](const OrthogonalStatistics& subset, const EvaluationSettings& settings) {
        return omme(subset, settings.definition);
      },
      "statistics"_a, "settings"_a);
}

}  // namespace trysquare::python
