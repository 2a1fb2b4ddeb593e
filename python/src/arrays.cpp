// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

#include "trysquare/core/error.h"

#include <algorithm>
#include <string>
#include <utility>

namespace trysquare::python {
namespace {

static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double), "a row of an (N, 3) array is an Eigen::Vector3d");

void write(const Pose& pose, double* rows) {
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) *rows++ = pose.rotation(row, column);
    *rows++ = pose.translation(row);
  }
  for (const double last : {0.0, 0.0, 0.0, 1.0}) *rows++ = last;
}

Pose read_pose(const double* rows, const std::string& name) {
  Pose pose;
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column) pose.rotation(row, column) = *rows++;
    pose.translation(row) = *rows++;
  }
  constexpr double kLastRow[] = {0, 0, 0, 1};
  if (!std::equal(kLastRow, kLastRow + 4, rows)) {
    throw InvalidArgument(name + ": the last row of a 4x4 pose must be 0 0 0 1");
  }
  return pose;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> codes_and_messages(const std::vector<Diagnostic>& diagnostics) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const Diagnostic& each : diagnostics) pairs.emplace_back(each.code, each.message);
  return pairs;
}

PointsView view_of(const PointArray& points) {
  return {reinterpret_cast<const Eigen::Vector3d*>(points.data()), points.shape(0)};
}

Trajectory trajectory_of(const PoseArray& poses, const std::optional<StampArray>& stamps_ns) {
  Trajectory trajectory;
  const std::size_t count = poses.shape(0);
  trajectory.world_from_scan.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    trajectory.world_from_scan.push_back(read_pose(poses.data() + 16 * i, "pose " + std::to_string(i)));
  }
  if (stamps_ns) {
    if (stamps_ns->shape(0) != count) {
      throw InvalidArgument(std::to_string(stamps_ns->shape(0)) + " stamps for " + std::to_string(count) +
                            " poses: there must be one for each");
    }
    trajectory.stamps_ns.assign(stamps_ns->data(), stamps_ns->data() + count);
  }
  return trajectory;
}

Pose pose_of(const MatrixArray& matrix) { return read_pose(matrix.data(), "matrix"); }

OrthogonalSubset subset_of(const std::vector<PointArray>& directions) {
  OrthogonalSubset subset;
  for (const PointArray& points : directions) {
    const PointsView view = view_of(points);
    subset.directions.push_back({.points_in_map = {view.begin(), view.end()}});
  }
  return subset;
}

Poses poses_of(const Trajectory& trajectory) {
  const std::size_t count = trajectory.size();
  auto* numbers = new double[16 * count];
  const nb::capsule owner(numbers, [](void* p) noexcept { delete[] static_cast<double*>(p); });
  for (std::size_t i = 0; i < count; ++i) write(trajectory.world_from_scan[i], numbers + 16 * i);
  return Poses(numbers, {count, 4, 4}, owner);
}

Matrix matrix_of(const Pose& pose) {
  auto* numbers = new double[16];
  const nb::capsule owner(numbers, [](void* p) noexcept { delete[] static_cast<double*>(p); });
  write(pose, numbers);
  return Matrix(numbers, {4, 4}, owner);
}

std::optional<Values<std::int64_t>> stamps_of(const Trajectory& trajectory) {
  if (trajectory.stamps_ns.empty()) return std::nullopt;
  return array_of(trajectory.stamps_ns);
}

Points array_of(std::vector<Eigen::Vector3d> points) {
  auto* owned = new std::vector<Eigen::Vector3d>(std::move(points));
  const nb::capsule owner(owned, [](void* p) noexcept { delete static_cast<std::vector<Eigen::Vector3d>*>(p); });
  return Points(reinterpret_cast<double*>(owned->data()), {owned->size(), 3}, owner);
}

Points view_of(const std::vector<Eigen::Vector3d>& points, nb::handle owner) {
  return Points(const_cast<double*>(reinterpret_cast<const double*>(points.data())), {points.size(), 3}, owner);
}

}  // namespace trysquare::python
