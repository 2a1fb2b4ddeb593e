// SPDX-License-Identifier: Apache-2.0
#include "trysquare/core/error.h"
#include "trysquare/core/some_scans.h"
#include "trysquare/io/file.h"
#include "trysquare/io/write_ply.h"
#include "trysquare/mapping/assemble_map.h"
#include "trysquare/metrics/extract_orthogonal_subset.h"
#include "trysquare/pipeline/orthogonal_windows.h"
#include "trysquare/report/orthogonal_figures.h"
#include "trysquare/report/orthogonal_json.h"

#include "commands.h"
#include "common_options.h"
#include "exit_codes.h"
#include "input_options.h"
#include "metric_options.h"
#include "outputs.h"
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace trysquare::app {
namespace {

constexpr const char* kFooter = R"(Examples:
  trysquare orthogonal sequences/00/velodyne sequences/00/poses.txt --window 5 --stride 1 --out results
  trysquare orthogonal scan.pcd --radius 0.2 --subset-method paper
With --window the directions of every window are sought by themselves: how far do they move? --every n, without --window,
does so for every scan that it leaves. Exit codes: 0 ok, 2 usage, 3 unreadable or malformed input, 4 no direction.)";

struct OrthogonalOptions {
  CommonOptions common;
  InputOptions input;
  MetricOptions metric;
  std::string directory;
  std::optional<std::size_t> window;
  std::optional<std::size_t> stride;

  std::optional<std::size_t> scans_in_window() const {
    return window || input.every == 1 ? window : std::optional<std::size_t>(1);
  }
  /// Before anything is read.
  void validate() const {
    if (window == 0U) throw InvalidArgument("--window 0 is out of range: it must be at least 1");
    if (stride == 0U) throw InvalidArgument("--stride 0 is out of range: it must be at least 1");
    if (stride && !scans_in_window()) throw InvalidArgument("--stride is given without --window");
  }
};

struct Sequence {
  std::unique_ptr<ScanSequence> scans;
  Trajectory world_from_scan;
  std::optional<std::string> extrinsic;
};

Sequence load_sequence(const OrthogonalOptions& options) {
  if (!options.input.poses.empty()) {
    Inputs inputs = load_inputs(options.input);
    options.common.warn(inputs.warnings);
    return {std::move(inputs.scans), std::move(inputs.world_from_scan),
            inputs.extrinsic ? std::optional(inputs.extrinsic->description) : std::nullopt};
  }
  std::unique_ptr<ScanSequence> scans = load_scans(options.input);
  if (scans->size() != 1) {
    throw InvalidArgument(fmt::format("{} scans without poses: give POSES, or one scan", scans->size()));
  }
  return {std::move(scans), {.world_from_scan = std::vector<Pose>(1)}, std::nullopt};
}

/// Of the scans that the method looks at, not of all: a sequence can be too long for memory.
RegisteredMap map_looked_at(const Sequence& sequence, const OrthogonalSubsetSettings& settings,
                            const Execution& execution) {
  const std::vector<std::uint32_t> looked_at = settings.scans_looked_at(sequence.scans->size());
  const std::vector<std::size_t> chosen(looked_at.begin(), looked_at.end());
  return assemble_map(SomeScans(*sequence.scans, chosen), take(sequence.world_from_scan, chosen), {}, execution).map;
}

std::string table_of(const OrthogonalSubsetResult& result) {
  std::string text = fmt::format("{} points looked at, {} planar", result.num_points, result.num_planar);
  if (result.planar_share()) text += fmt::format(" ({:.1f} %)", 100 * *result.planar_share());
  text += fmt::format(", {} groups of normals\n\n", result.num_clusters);
  for (std::size_t i = 0; i < result.subset.directions.size(); ++i) {
    const OrthogonalSubset::Direction& direction = result.subset.directions[i];
    text += fmt::format("  direction {}: {:6} points, normal [{:8.5f} {:8.5f} {:8.5f}]\n", i + 1,
                        direction.points_in_map.size(), direction.normal_in_map.x(), direction.normal_in_map.y(),
                        direction.normal_in_map.z());
  }
  if (!result.reason.empty()) text += "  " + result.reason + "\n";
  return text;
}

/// How many windows have three directions, how many points these have, and how far they move.
std::string table_of(const std::vector<OrthogonalWindow>& windows) {
  constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
  std::array<std::size_t, 3> num_with{};
  std::array<std::size_t, 3> num_points{};
  for (const OrthogonalWindow& window : windows) {
    for (std::size_t i = 0; i < window.directions.size(); ++i) {
      ++num_with[i];
      num_points[i] += window.directions[i].num_points;
    }
  }
  std::string text = fmt::format("\n{} windows; one direction or more in {}, two or more in {}, three in {}\n",
                                 windows.size(), num_with[0], num_with[1], num_with[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    if (num_with[i] == 0) continue;
    text += fmt::format("  direction {}: {:8.1f} points in the mean\n", i + 1,
                        static_cast<double>(num_points[i]) / static_cast<double>(num_with[i]));
  }
  const std::optional<double> largest_rad = largest_move_rad(windows);
  if (largest_rad) {
    text += fmt::format("  largest move of a direction from one window to the next: {:.2f} degrees\n",
                        *largest_rad * kDegreesPerRadian);
  }
  return text;
}

/// All points in grey, those of the subset in red, green and blue with their direction (1, 2, 3) as a scalar.
PointTable colored_points(const RegisteredMap& map, const OrthogonalSubset& subset) {
  using Color = std::array<std::uint8_t, 3>;
  constexpr std::array<Color, 3> kColors = {{{198, 47, 47}, {46, 139, 61}, {43, 95, 199}}};
  constexpr Color kGrey = {170, 170, 170};
  PointTable table{.points = map.points_in_map,
                   .columns = {{"direction", direction_of_points(map, subset)}},
                   .colors = std::vector<Color>(map.points_in_map.size(), kGrey)};
  for (std::size_t i = 0; i < table.points.size(); ++i) {
    const double direction = table.columns[0].values[i];
    if (direction >= 1) table.colors[i] = kColors.at(static_cast<std::size_t>(direction) - 1);
  }
  return table;
}

/// Figures of an earlier run do not stay beside results that have none.
void write_or_remove(const std::filesystem::path& file, const std::optional<std::string>& text) {
  if (text) return write_file(file, *text);
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
}

void write_folder(const std::filesystem::path& folder, const RegisteredMap& map, const OrthogonalSubset& subset,
                  const std::string& json, const std::vector<OrthogonalWindow>& windows) {
  const bool has_direction = std::any_of(windows.begin(), windows.end(),
                                         [](const OrthogonalWindow& window) { return !window.directions.empty(); });
  using Text = std::optional<std::string>;
  make_folder(folder);
  write_file(folder / "orthogonal.json", json);
  write_ply(folder / "orthogonal.ply", colored_points(map, subset));
  write_or_remove(folder / "orthogonal.svg",
                  map.points_in_map.empty() ? Text() : Text(orthogonal_picture(map.points_in_map, subset).svg));
  write_or_remove(folder / "windows.csv", windows.empty() ? Text() : Text(orthogonal_windows_csv(json)));
  write_or_remove(folder / "windows.svg", has_direction ? Text(orthogonal_windows_figure(json).svg) : Text());
}

/// Windows, and what is to be said of those that could not be had.
struct Windows {
  std::vector<OrthogonalWindow> windows;
  std::string reason = "not asked for";
};

Windows look_at_windows(const OrthogonalOptions& options, const Sequence& sequence, const EvaluationSettings& settings,
                        const Execution& execution) {
  Windows result;
  const std::optional<std::size_t> window = options.scans_in_window();
  if (!window) return result;
  result.windows =
      orthogonal_windows(*sequence.scans, sequence.world_from_scan, *window, options.stride.value_or(*window),
                         settings.radius_m, settings.orthogonal, execution);
  const std::size_t num_scans = sequence.scans->size();
  if (result.windows.empty()) {
    result.reason = fmt::format("a window of {} scans does not fit into {}", *window, num_scans);
    options.common.warn({{"no_window", result.reason}});
  } else if (const std::size_t num_left = num_scans - 1 - result.windows.back().last; num_left > 0) {
    options.common.warn({{"incomplete_window",
                          fmt::format("the last {} scans fill no window of {} and are in none", num_left, *window)}});
  }
  return result;
}

void run(const OrthogonalOptions& options) {
  options.validate();
  const EvaluationSettings settings = options.metric.resolve();
  if (!options.common.json.empty() && options.common.json != "-") require_writable_file(options.common.json);
  if (!options.directory.empty()) require_possible_folder(options.directory);
  const Execution execution = options.common.execution();
  const Sequence sequence = load_sequence(options);
  const RegisteredMap map = map_looked_at(sequence, settings.orthogonal, execution);
  const OrthogonalSubsetResult result =
      extract_orthogonal_subset(map, settings.radius_m, settings.orthogonal, execution);
  const Windows looked_at = look_at_windows(options, sequence, settings, execution);
  const std::vector<OrthogonalWindow>& windows = looked_at.windows;
  const std::string json =
      to_json(result, settings.orthogonal,
              {.version = TRYSQUARE_VERSION,
               .scans = options.input.scans,
               .poses = options.input.poses.empty() ? std::nullopt : std::optional(options.input.poses),
               .left_handed = options.input.left_handed,
               .extrinsic = sequence.extrinsic,
               .radius_m = settings.radius_m,
               .num_scans = sequence.scans->size(),
               .windows_reason = looked_at.reason},
              windows);
  if (!options.directory.empty()) write_folder(options.directory, map, result.subset, json, windows);
  if (options.common.prints_tables()) fmt::print("{}{}", table_of(result), windows.empty() ? "" : table_of(windows));
  write_json(options.common.json, json);
  if (result.subset.directions.empty()) throw NotMeaningful();
}

}  // namespace

void add_orthogonal(CLI::App& app) {
  auto options = std::make_shared<OrthogonalOptions>();
  CLI::App& verb = *app.add_subcommand("orthogonal", "The mutually orthogonal surfaces that MOM and OMME look at");
  verb.footer(kFooter);
  add_common_options(verb, options->common);
  add_json_option(verb, options->common);
  verb.add_option("SCANS", options->input.scans, "Scans: folder, quoted pattern, KITTI sequence, or one file")
      ->required();
  verb.add_option("POSES", options->input.poses, "Poses; not needed for one scan");
  verb.add_option("--window", options->window, "Also look at every window of this many scans by itself");
  verb.add_option("--stride", options->stride, "Scans from one window to the next; default: the window");
  add_orthogonal_options(verb, options->metric);
  add_scan_options(verb, options->input);
  add_pose_options(verb, options->input);
  verb.add_option(
          "--out", options->directory,
          "Write orthogonal.json, .ply (red, green, blue on grey) and .svg into this folder, and windows.csv and "
          ".svg where there are windows")
      ->group("Outputs");
  verb.callback([options] { run(*options); });
}

}  // namespace trysquare::app
