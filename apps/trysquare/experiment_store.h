// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/experiments/experiment.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace trysquare::app {

/// Metric samples as CSV: a line of column names and one a trajectory, with all digits; empty cells where undefined.
std::string samples_csv(const MetricSamples& samples);

/// What samples_csv() wrote; nullopt when the text is not that, whole: cut off, say, in the middle of a line.
/// @param num_trajectories  Lines that there must be.
std::optional<MetricSamples> parse_samples_csv(std::string_view text, std::size_t num_trajectories);

/// The folder of one experiment, which remembers what is done: `settings.json` and, for each finished study,
/// `samples/<name>.csv`. Each file is written whole or not at all.
class ExperimentStore {
 public:
  /// Makes the folder, or goes on with it.
  /// @throws IoError  if the folder is of an experiment with other settings, or cannot be written.
  ExperimentStore(std::filesystem::path folder, const std::string& settings_json);

  /// The samples of a finished study; nullopt when it is not finished, or its file is damaged.
  std::optional<MetricSamples> load(const ExperimentUnit& unit, std::size_t num_trajectories) const;

  void save(const ExperimentUnit& unit, const MetricSamples& samples) const;

  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path file_of(const ExperimentUnit& unit) const;

  std::filesystem::path folder_;
};

}  // namespace trysquare::app
