// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/orthogonal_subset_file.h"

#include "trysquare/core/error.h"
#include "trysquare/io/read_points.h"
#include "trysquare/io/scan_files.h"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

namespace trysquare {

std::vector<std::vector<Eigen::Vector3d>> read_point_groups(std::string_view spec) {
  std::vector<std::vector<Eigen::Vector3d>> groups;
  for (const std::filesystem::path& path : expand_files(spec)) {
    std::vector<Eigen::Vector3d> points = read_points(path, Columns::kNone).points;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!points[i].allFinite()) {
        throw IoError(
            fmt::format("{}: point {} is not finite, expected points of an orthogonal subset", path.string(), i));
      }
    }
    groups.push_back(std::move(points));
  }
  return groups;
}

}  // namespace trysquare
