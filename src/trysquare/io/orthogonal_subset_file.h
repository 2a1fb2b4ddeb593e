// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace trysquare {

/// A precomputed orthogonal subset: one point file (NPY, PLY, PCD, ...) for each direction.
/// @param spec      what expand_files takes: a pattern, a comma list, a directory.
/// @return          for each file, in order, its points [m], in the frame in which they were stored.
/// @throws IoError  if a file cannot be read, holds a point that is not finite, or is a pickled object array.
std::vector<std::vector<Eigen::Vector3d>> read_point_groups(std::string_view spec);

}  // namespace trysquare
