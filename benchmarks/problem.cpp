// SPDX-License-Identifier: Apache-2.0
#include "problem.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace trysquare::bench {
namespace {

static_assert(std::endian::native == std::endian::little, "map files are read and written as they lie in memory");

struct Record {
  double x, y, z, scan;
};
static_assert(sizeof(Record) == 32);

constexpr std::size_t kRecordsPerPiece = 4096;
constexpr std::size_t kQueriesPerBlock = 64;
constexpr double kMaxNumScans = 1e6;  // counters of scans are as long as the largest index

void append(const Record& record, const std::filesystem::path& path, Problem& problem) {
  const double last = problem.scan_of_point.empty() ? 0.0 : problem.scan_of_point.back();
  if (!(record.scan >= last && record.scan < kMaxNumScans) || record.scan != std::floor(record.scan)) {
    throw std::runtime_error(path.string() + ": the scans of its points must be whole numbers that do not decrease");
  }
  problem.points_in_map.emplace_back(record.x, record.y, record.z);
  problem.scan_of_point.push_back(static_cast<std::uint32_t>(record.scan));
}

void choose_queries(const QuerySettings& settings, Problem& problem) {
  const auto end_of_scan0 = std::ranges::upper_bound(problem.scan_of_point, 0U);
  const auto num_candidates = settings.fixed_scan0
                                  ? static_cast<std::size_t>(end_of_scan0 - problem.scan_of_point.begin())
                                  : problem.points_in_map.size();
  problem.queries_are_all_points = settings.every == 1 && num_candidates == problem.points_in_map.size();
  if (problem.queries_are_all_points) return;
  for (std::size_t i = 0; i < num_candidates; ++i) {
    if (i / kQueriesPerBlock % settings.every == 0) problem.subset_in_map.push_back(problem.points_in_map[i]);
  }
}

}  // namespace

Problem read_problem(const std::filesystem::path& path, const QuerySettings& settings) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path.string() + ": cannot be opened");
  const std::size_t num_bytes = std::filesystem::file_size(path);
  if (num_bytes == 0 || num_bytes % sizeof(Record) != 0) {
    throw std::runtime_error(path.string() + ": its size is no whole number of records of 32 bytes");
  }
  Problem problem;
  problem.points_in_map.reserve(num_bytes / sizeof(Record));
  problem.scan_of_point.reserve(num_bytes / sizeof(Record));
  std::array<Record, kRecordsPerPiece> piece;
  while (problem.points_in_map.size() < num_bytes / sizeof(Record)) {
    const std::size_t count = std::min(piece.size(), num_bytes / sizeof(Record) - problem.points_in_map.size());
    if (!file.read(reinterpret_cast<char*>(piece.data()), static_cast<std::streamsize>(count * sizeof(Record)))) {
      throw std::runtime_error(path.string() + ": cannot be read to its end");
    }
    for (const Record& record : std::span(piece).first(count)) append(record, path, problem);
  }
  problem.num_scans = problem.scan_of_point.back() + std::size_t{1};
  choose_queries(settings, problem);
  return problem;
}

void write_map_file(const std::filesystem::path& path, std::span<const Eigen::Vector3d> points_in_map,
                    std::span<const std::uint32_t> scan_of_point) {
  std::ofstream file(path, std::ios::binary);
  for (std::size_t i = 0; i < points_in_map.size(); ++i) {
    const Eigen::Vector3d& p = points_in_map[i];
    const Record record{p.x(), p.y(), p.z(), static_cast<double>(scan_of_point[i])};
    file.write(reinterpret_cast<const char*>(&record), sizeof(record));
  }
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace trysquare::bench
