// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/metrics/nearest_neighbor_normals.h"
#include "trysquare/metrics/normal_clusters.h"
#include "trysquare/metrics/orthogonal_clique.h"
#include "trysquare/metrics/planar_points.h"

#include "arrays.h"
#include "bind.h"
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

// The steps of the paper's extraction one by one, for the drop-in of map-metrics, whose settings go further than ours.
namespace trysquare::python {
namespace {

using namespace nb::literals;

Points planar(const PointArray& points, double radius_m, double planarity_ratio, int min_neighbors, int threads) {
  const PointsView view = view_of(points);
  PlanarPoints found;
  {
    const nb::gil_scoped_release release;
    const Execution execution{.num_threads = threads, .progress = {}};
    const NeighborhoodSettings settings{.radius_m = radius_m, .min_neighbors = min_neighbors};
    found = planar_points(PointIndex(view, execution), view, settings, planarity_ratio, execution);
  }
  return array_of(std::move(found.points));
}

Points normals_of(const PointArray& scan, const PointArray& queries, double radius_m, std::size_t max_nearest,
                  int threads) {
  const PointsView scan_view = view_of(scan);
  const PointsView query_view = view_of(queries);
  std::vector<Eigen::Vector3d> normals;
  {
    const nb::gil_scoped_release release;
    const Execution execution{.num_threads = threads, .progress = {}};
    normals = nearest_neighbor_normals(scan_view, query_view, radius_m, max_nearest, execution);
  }
  return array_of(std::move(normals));
}

Values<std::uint32_t> wards_labels_of(const PointArray& normals, double cut) {
  const PointsView view = view_of(normals);
  const NormalClusterSettings settings{.linkage = Linkage::kWard, .cut = cut, .sign_free = false};
  std::vector<std::uint32_t> labels;
  {
    const nb::gil_scoped_release release;
    labels = cluster_normals(view, settings);
  }
  return array_of(std::move(labels));
}

std::vector<std::size_t> clique_of(const PointArray& normals, const std::vector<std::size_t>& num_points,
                                   double orthogonality_bound) {
  const PointsView view = view_of(normals);
  if (num_points.size() != view.size()) throw InvalidArgument("num_points: expected one for each normal");
  std::vector<NormalCluster> clusters;
  for (std::size_t i = 0; i < view.size(); ++i) clusters.push_back({.normal = view[i], .num_points = num_points[i]});
  return largest_orthogonal_clique(clusters, orthogonality_bound);
}

}  // namespace

void bind_clusters(nb::module_& module) {
  module.def("planar_points", &planar, "points"_a, "radius_m"_a, "planarity_ratio"_a, "min_neighbors"_a, "threads"_a);
  module.def("nearest_neighbor_normals", &normals_of, "scan"_a, "queries"_a, "radius_m"_a, "max_nearest"_a,
             "threads"_a);
  module.def("ward_clusters", &wards_labels_of, "normals"_a, "cut"_a);
  module.def("largest_orthogonal_clique", &clique_of, "normals"_a, "num_points"_a, "orthogonality_bound"_a);
}

}  // namespace trysquare::python
