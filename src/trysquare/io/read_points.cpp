// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/read_points.h"

#include "trysquare/core/error.h"
#include "trysquare/core/measured_points.h"
#include "trysquare/io/file.h"
#include "trysquare/io/internal/text.h"
#include "trysquare/io/read_bin.h"
#include "trysquare/io/read_npy.h"
#include "trysquare/io/read_pcd.h"
#include "trysquare/io/read_ply.h"
#include "trysquare/io/read_xyz.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace trysquare {
namespace {

/// Longer endings before the ones that they end with.
constexpr std::array<std::pair<std::string_view, PointFormat>, 10> kEndings = {{{".pcd.bin", PointFormat::kNuScenesBin},
                                                                                {".bin", PointFormat::kKittiBin},
                                                                                {".pcd", PointFormat::kPcd},
                                                                                {".ply", PointFormat::kPly},
                                                                                {".npy", PointFormat::kNpy},
                                                                                {".xyz", PointFormat::kXyz},
                                                                                {".txt", PointFormat::kXyz},
                                                                                {".csv", PointFormat::kXyz},
                                                                                {".asc", PointFormat::kXyz},
                                                                                {".pts", PointFormat::kXyz}}};

}  // namespace

std::optional<PointFormat> known_point_format(const std::filesystem::path& path) {
  const std::string file_name = internal::lower_case(path.filename().string());
  for (const auto& [ending, format] : kEndings) {
    if (file_name.ends_with(ending)) return format;
  }
  return std::nullopt;
}

PointFormat point_format_of(const std::filesystem::path& path) {
  if (const std::optional<PointFormat> format = known_point_format(path)) return *format;
  std::string known;
  for (const auto& [ending, format] : kEndings) known += fmt::format(" {}", ending);
  throw IoError(
      fmt::format("{}: the ending of the name is not that of a point format, expected one of{}", path.string(), known));
}

PointTable parse_points(std::string_view bytes, PointFormat format, std::string_view name, Columns columns) {
  switch (format) {
    case PointFormat::kKittiBin:
      return parse_kitti_bin(bytes, name, columns);
    case PointFormat::kNuScenesBin:
      return parse_nuscenes_bin(bytes, name, columns);
    case PointFormat::kPcd:
      return parse_pcd(bytes, name, columns);
    case PointFormat::kPly:
      return parse_ply(bytes, name, columns);
    case PointFormat::kNpy:
      return parse_npy(bytes, name, columns);
    case PointFormat::kXyz:
      break;
  }
  return parse_xyz(bytes, name, columns);
}

PointTable read_points(const std::filesystem::path& path, Columns columns) {
  const PointFormat format = point_format_of(path);
  return parse_points(read_file(path), format, path.string(), columns);
}

Scan read_scan(const std::filesystem::path& path) { return scan_of_measured(read_points(path, Columns::kNone).points); }

Scan read_map(const std::filesystem::path& path) { return map_of_measured(read_points(path, Columns::kNone).points); }

}  // namespace trysquare
