// SPDX-License-Identifier: Apache-2.0
#include "trysquare/io/internal/matrix_rows.h"

#include "trysquare/core/error.h"
#include "trysquare/io/internal/text.h"

#include <fmt/format.h>

#include <vector>

namespace trysquare::internal {
namespace {

constexpr std::size_t kRowValues = 4;
constexpr std::size_t kMatrixValues = 16;
constexpr std::size_t kUpperValues = 12;

/// All numbers of a text and where they stand. Lines hold 4 numbers, or a whole matrix of 16 (12).
struct Rows {
  std::vector<double> values;
  std::vector<std::size_t> lines;  ///< Of each run of four values.
};

Rows read_rows(std::string_view text, std::string_view name, PoseCollector& poses) {
  Rows rows;
  LineReader lines(text);
  std::vector<std::string_view> fields;
  std::vector<double> numbers;
  for (std::string_view line; lines.next(line);) {
    const std::string_view content = trimmed(without_comment(line));
    if (content.empty()) continue;
    read_numbers(name, lines.line_number(), content, numbers);
    if (numbers.size() != kRowValues && numbers.size() != kMatrixValues && numbers.size() != kUpperValues) {
      fail_at_line(name, lines.line_number(),
                   fmt::format("found {} values, expected a row of 4, or a matrix of 16 (or 12)", numbers.size()));
    }
    split_fields(content, fields);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const bool last_row = (rows.values.size() + i) % kMatrixValues >= kUpperValues;
      if (i % kRowValues == kRowValues - 1 && !last_row) poses.note_printed(fields[i]);
    }
    rows.values.insert(rows.values.end(), numbers.begin(), numbers.end());
    rows.lines.insert(rows.lines.end(), numbers.size() / kRowValues, lines.line_number());
  }
  return rows;
}

}  // namespace

void collect_matrices(std::string_view text, std::string_view name, PoseCollector& poses) {
  const Rows rows = read_rows(text, name, poses);
  if (rows.values.empty()) throw IoError(fmt::format("{}: line 1: found no numbers, expected a matrix", name));
  const bool upper_only = rows.values.size() == kUpperValues;
  const std::size_t stride = upper_only ? kUpperValues : kMatrixValues;
  if (rows.values.size() % stride != 0) {
    fail_at_line(name, rows.lines.back(),
                 fmt::format("found {} rows of 4 numbers in all, expected 4 for each matrix", rows.lines.size()));
  }
  for (std::size_t first = 0; first < rows.values.size(); first += stride) {
    poses.add_matrix_pose(std::span(rows.values).subspan(first, stride), {name, rows.lines[first / kRowValues]});
  }
}

void collect_one_matrix(std::string_view text, std::string_view name, PoseCollector& poses) {
  LineReader lines(text);
  std::size_t num_values = 0;
  for (std::string_view line; lines.next(line);) {
    FieldReader reader(trimmed(without_comment(line)));
    for (std::string_view field; reader.next(field);) ++num_values;
    if (num_values > kMatrixValues) {
      fail_at_line(name, lines.line_number(), "found more than 16 values, expected one 4×4 matrix (or 3×4)");
    }
  }
  collect_matrices(text, name, poses);
}

}  // namespace trysquare::internal
