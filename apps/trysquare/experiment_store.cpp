// SPDX-License-Identifier: Apache-2.0
#include "experiment_store.h"

#include "trysquare/core/error.h"
#include "trysquare/io/file.h"

#include "outputs.h"
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace trysquare::app {
namespace {

namespace fs = std::filesystem;

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> number_in(std::string_view cell) {
  if (cell.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::vector<double>> row_in(std::string_view line, std::size_t num_columns) {
  std::vector<double> row;
  for (const std::string_view cell : split(line, ',')) {
    const std::optional<double> value = number_in(cell);
    if (!value) return std::nullopt;
    row.push_back(*value);
  }
  if (row.size() != num_columns) return std::nullopt;
  return row;
}

}  // namespace

std::string samples_csv(const MetricSamples& samples) {
  std::string text = fmt::format("{}\n", fmt::join(samples.columns, ","));
  for (const std::vector<double>& row : samples.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) text += ',';
      if (!std::isnan(row[i])) text += fmt::format("{}", row[i]);
    }
    text += '\n';
  }
  return text;
}

std::optional<MetricSamples> parse_samples_csv(std::string_view text, std::size_t num_trajectories) {
  std::vector<std::string_view> lines = split(text, '\n');
  if (lines.size() != num_trajectories + 2 || !lines.back().empty()) return std::nullopt;  // the last line ends, too
  MetricSamples samples;
  for (const std::string_view name : split(lines.front(), ',')) samples.columns.emplace_back(name);
  for (std::size_t i = 1; i + 1 < lines.size(); ++i) {
    std::optional<std::vector<double>> row = row_in(lines[i], samples.columns.size());
    if (!row) return std::nullopt;
    samples.rows.push_back(std::move(*row));
  }
  return samples;
}

ExperimentStore::ExperimentStore(fs::path folder, const std::string& settings_json) : folder_(std::move(folder)) {
  const fs::path file = folder_ / "settings.json";
  std::error_code ignored;
  if (fs::exists(file, ignored)) {
    if (read_file(file) == settings_json) return;
    throw IoError(fmt::format(
        "{}: the folder holds an experiment with other settings, or of another version; use another folder, or remove "
        "this one",
        file.string()));
  }
  make_folder(folder_ / "samples");
  write_file(file, settings_json);
}

fs::path ExperimentStore::file_of(const ExperimentUnit& unit) const {
  return folder_ / "samples" / (unit.name() + ".csv");
}

std::optional<MetricSamples> ExperimentStore::load(const ExperimentUnit& unit, std::size_t num_trajectories) const {
  std::error_code ignored;
  if (!fs::exists(file_of(unit), ignored)) return std::nullopt;
  return parse_samples_csv(read_file(file_of(unit)), num_trajectories);
}

void ExperimentStore::save(const ExperimentUnit& unit, const MetricSamples& samples) const {
  make_folder(folder_ / "samples");
  write_file(file_of(unit), samples_csv(samples));
}

}  // namespace trysquare::app
