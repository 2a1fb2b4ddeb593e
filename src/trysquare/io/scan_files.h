// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/scan.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trysquare {

/// The point files that a user names: a directory, a file, a pattern (* ? [..]), or a comma list of files and patterns.
/// Directories and patterns come in natural order (scan2 before scan10), lists as they are. Of a directory, hidden
/// files and files that are no point format are left out, and .txt and .csv, which may be anything, where there are
/// others.
/// @throws IoError  if nothing is found, or a directory holds point files of several kinds.
std::vector<std::filesystem::path> expand_files(std::string_view spec);

/// The frame number in a file's name: its last digits, 17 of 000017.ply and of lidar_17.ply.
std::optional<std::int64_t> number_in_name(const std::filesystem::path& path);

/// Scans that are one file each, read when asked for.
class ScanFiles : public ScanSequence {
 public:
  /// @param stamps_ns        one for each path, or none.
  /// @throws InvalidArgument  if the numbers of both differ.
  explicit ScanFiles(std::vector<std::filesystem::path> paths, std::vector<std::int64_t> stamps_ns = {});

  std::size_t size() const override { return paths_.size(); }
  Scan load(std::size_t index) const override;
  std::string name(std::size_t index) const override;

  const std::vector<std::filesystem::path>& paths() const { return paths_; }
  const std::vector<std::int64_t>& stamps_ns() const { return stamps_ns_; }

 private:
  std::vector<std::filesystem::path> paths_;
  std::vector<std::int64_t> stamps_ns_;
};

/// What SCANS on the command line stands for: everything that expand_files takes, or the root of a KITTI sequence,
/// whose scans are velodyne/*.bin. Time stamps are taken
///   from times.txt beside a folder velodyne (seconds, one a line; line n, from 0, belongs to the file called n, or to
///   the n-th file when the names are no such numbers),
///   or from the names of the files when every one is a time: 1403715524907143168.pcd [ns], 1311868164.363181.ply [s].
/// @throws IoError  if there are no scans, or times.txt is malformed or has no line for a scan.
ScanFiles open_scans(std::string_view spec);

}  // namespace trysquare
