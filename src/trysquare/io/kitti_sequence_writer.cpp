// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/kitti_sequence_writer.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"
#include "trysquare/io/write_bin.h"
#include "trysquare/io/write_trajectory.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <string>
#include <system_error>

namespace trysquare {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> kEntries = {"velodyne", "poses.txt", "times.txt", "calib.txt"};

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw IoError(fmt::format("{}: cannot be written: {}", path.string(), reason));
}

void require_free(const fs::path& folder, bool replaces) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status)) fail(folder, "it is a file, expected a folder");
  const bool is_empty = fs::is_empty(folder, error);
  if (error) fail(folder, error.message());
  if (!is_empty && !replaces) fail(folder, "the folder exists and is not empty");
}

/// A new folder beside `folder`, so that it can be renamed to it.
fs::path make_temporary(const fs::path& folder) {
  constexpr int kMaxAttempts = 100;
  std::error_code error;
  fs::create_directories(folder.parent_path(), error);
  for (int attempt = 0; attempt < kMaxAttempts && !error; ++attempt) {
    const fs::path candidate = folder.parent_path() / fmt::format(".trysquare-{}-{}.tmp", ::getpid(), attempt);
    if (fs::create_directory(candidate, error)) return candidate;
  }
  fail(folder, error ? error.message() : "no name is free for a temporary folder beside it");
}

/// Seconds, exact to the nanosecond.
std::string times_of(const Trajectory& trajectory) {
  constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
  std::string text;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const std::int64_t stamp_ns =
        trajectory.stamps_ns.empty() ? static_cast<std::int64_t>(i) * kNanosecondsPerSecond : trajectory.stamps_ns[i];
    const std::uint64_t magnitude =
        stamp_ns < 0 ? 0 - static_cast<std::uint64_t>(stamp_ns) : static_cast<std::uint64_t>(stamp_ns);
    text += fmt::format("{}{}.{:09}\n", stamp_ns < 0 ? "-" : "", magnitude / kNanosecondsPerSecond,
                        magnitude % kNanosecondsPerSecond);
  }
  return text;
}

}  // namespace

KittiSequenceWriter::KittiSequenceWriter(const fs::path& folder, bool replaces)
    : folder_(fs::absolute(folder).lexically_normal()) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // of "out/"
  require_free(folder_, replaces);
  temporary_ = make_temporary(folder_);
  std::error_code error;
  fs::create_directory(temporary_ / "velodyne", error);
  if (error) fail(folder_, error.message());
}

KittiSequenceWriter::~KittiSequenceWriter() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

void KittiSequenceWriter::write_scan(std::size_t index, PointsView points_in_scan) const {
  write_kitti_bin(temporary_ / "velodyne" / fmt::format("{:06}.bin", index), points_in_scan);
}

void KittiSequenceWriter::finish(const Trajectory& world_from_scan) {
  write_trajectory(temporary_ / "poses.txt", world_from_scan, TrajectoryFormat::kKitti);
  write_file(temporary_ / "times.txt", times_of(world_from_scan));
  write_file(temporary_ / "calib.txt", "Tr: 1 0 0 0 0 1 0 0 0 0 1 0\n");
  put_in_place();
}

void KittiSequenceWriter::put_in_place() {
  std::error_code error;
  if (!fs::exists(folder_) || fs::is_empty(folder_, error)) {
    fs::rename(temporary_, folder_, error);  // takes the place of an empty folder
    if (error) fail(folder_, error.message());
    temporary_.clear();
    return;
  }
  const fs::path old = temporary_ / "old";
  fs::create_directory(old, error);
  for (const char* entry : kEntries) {
    std::error_code missing;
    fs::rename(folder_ / entry, old / entry, missing);
    fs::rename(temporary_ / entry, folder_ / entry, error);
    if (error) fail(folder_ / entry, error.message());
  }
}

}  // namespace trysquare
