// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/diagnostic.h"
#include "trysquare/core/points.h"
#include "trysquare/core/pose.h"
#include "trysquare/core/trajectory.h"
#include "trysquare/metrics/orthogonal_subset.h"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trysquare::python {

namespace nb = nanobind;

// What comes in. The Python side makes arrays of these types and shapes first (trysquare/_arrays.py).
using PointArray = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using PoseArray = nb::ndarray<const double, nb::shape<-1, 4, 4>, nb::c_contig, nb::device::cpu>;
using MatrixArray = nb::ndarray<const double, nb::shape<4, 4>, nb::c_contig, nb::device::cpu>;
using StampArray = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

// What goes out.
using Points = nb::ndarray<nb::numpy, double, nb::shape<-1, 3>>;
using Poses = nb::ndarray<nb::numpy, double, nb::shape<-1, 4, 4>>;
using Matrix = nb::ndarray<nb::numpy, double, nb::shape<4, 4>>;
template <class T>
using Values = nb::ndarray<nb::numpy, T, nb::ndim<1>>;

/// The points of an array, which must outlive the view.
PointsView view_of(const PointArray& points);

/// Poses and, where there are some, their stamps [ns]; the last row of every matrix is checked.
/// @throws InvalidArgument  if a last row is not 0 0 0 1, or there is not one stamp for each pose.
Trajectory trajectory_of(const PoseArray& poses, const std::optional<StampArray>& stamps_ns = {});
Pose pose_of(const MatrixArray& matrix);

/// One direction an array, map frame; copies the points.
OrthogonalSubset subset_of(const std::vector<PointArray>& directions);

Poses poses_of(const Trajectory& trajectory);
Matrix matrix_of(const Pose& pose);
std::optional<Values<std::int64_t>> stamps_of(const Trajectory& trajectory);

/// Policy of properties whose array owns its values: nanobind's own for properties would tie it to the object.
inline constexpr auto kOwnValues = nb::rv_policy::automatic;

/// (code, message) of each.
std::vector<std::pair<std::string, std::string>> codes_and_messages(const std::vector<Diagnostic>& diagnostics);

/// An array that owns the values: nothing is copied.
template <class T>
Values<T> array_of(std::vector<T> values) {
  auto* owned = new std::vector<T>(std::move(values));
  const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return Values<T>(owned->data(), {owned->size()}, owner);
}
Points array_of(std::vector<Eigen::Vector3d> points);

/// Views into something that Python holds: `owner` keeps it alive.
template <class T>
Values<T> view_of(const std::vector<T>& values, nb::handle owner) {
  return Values<T>(const_cast<T*>(values.data()), {values.size()}, owner);
}
Points view_of(const std::vector<Eigen::Vector3d>& points, nb::handle owner);

}  // namespace trysquare::python
