// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/evo_result.h"

#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/statistics_json.h"
#include "trysquare/trajectory/error_unit.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <utility>

namespace trysquare {
namespace {

using internal::Json;

/// In the order of the enumerators.
constexpr std::array<std::string_view, 7> kRelations = {
    "full transformation",       "translation part",          "rotation part",
    "rotation angle in degrees", "rotation angle in radians", "point distance",
    "point distance error ratio"};
constexpr std::array<std::string_view, 4> kDeltaUnits = {"frames", "m", "deg", "rad"};
constexpr std::array<std::string_view, 5> kAlignments = {"(not aligned)", "(with origin alignment)",
                                                         "(scale corrected)", "(with SE(3) Umeyama alignment)",
                                                         "(with Sim(3) Umeyama alignment)"};

template <std::size_t N, class Enum>
std::string_view long_name(const std::array<std::string_view, N>& names, Enum value) {
  return names[static_cast<std::size_t>(value)];
}

template <class Settings>
std::string how_aligned(const Settings& settings) {
  std::string text(long_name(kAlignments, settings.alignment));
  if (settings.num_poses_to_align > 0) text += fmt::format(" (aligned poses: {})", settings.num_poses_to_align);
  if (settings.projection) text += fmt::format("\n(projected to {} plane)", name_of(*settings.projection));
  return text;
}

/// 4×4, the scale multiplied into the rotation part, as evo stores a Sim(3).
std::vector<double> matrix_of(const Similarity& b_from_a) {
  std::vector<double> rows;
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) rows.push_back(b_from_a.scale * b_from_a.pose.rotation(i, j));
    rows.push_back(b_from_a.pose.translation[i]);
  }
  rows.insert(rows.end(), {0, 0, 0, 1});
  return rows;
}

/// Python's text of a number that argparse made a float; an int for frames.
std::string delta_text(const PosePairSettings& pairs) {
  if (pairs.delta != std::floor(pairs.delta)) return fmt::format("{}", pairs.delta);
  return fmt::format("{:.{}f}", pairs.delta, pairs.unit == DeltaUnit::kFrames ? 0 : 1);
}

EvoResult result_of(const char* metric, const std::string& title, const TrajectoryErrors& errors, Alignment alignment,
                    const ErrorSeries& series, const std::string& reference_name, const std::string& estimate_name) {
  EvoResult result;
  result.info_json = internal::dump({{"title", title},
                                     {"ref_name", reference_name},
                                     {"est_name", estimate_name},
                                     {"label", fmt::format("{} ({})", metric, unit_of(errors))}});
  Json stats = Json::object();
  internal::set_statistics(stats, errors.statistics);
  result.stats_json = internal::dump(stats);
  result.arrays.push_back({"error_array", errors.errors});
  if (!series.stamps_s.empty()) {
    result.arrays.push_back({"seconds_from_start", series.seconds_from_start});
    result.arrays.push_back({"timestamps", series.stamps_s});
    result.arrays.push_back({"distances_from_start", series.reference_distances_m});
    result.arrays.push_back({"distances", series.estimate_distances_m});
  }
  if (alignment != Alignment::kNone) {
    result.arrays.push_back({"alignment_transformation_sim3", matrix_of(errors.reference_from_estimate), 4});
  }
  return result;
}

}  // namespace

EvoResult evo_result(const TrajectoryErrors& errors, const ApeSettings& settings, const ErrorSeries& series,
                     const std::string& reference_name, const std::string& estimate_name) {
  const std::string title = fmt::format("APE w.r.t. {} ({})\n{}", long_name(kRelations, errors.relation),
                                        unit_of(errors), how_aligned(settings));
  return result_of("APE", title, errors, settings.alignment, series, reference_name, estimate_name);
}

EvoResult evo_result(const TrajectoryErrors& errors, const RpeSettings& settings, const ErrorSeries& series,
                     const std::string& reference_name, const std::string& estimate_name) {
  const std::string title =
      fmt::format("RPE w.r.t. {} ({})\nfor delta = {} ({}) using {} pairs\n{}", long_name(kRelations, errors.relation),
                  unit_of(errors), delta_text(settings.pairs), long_name(kDeltaUnits, settings.pairs.unit),
                  settings.pairs.all_pairs ? "all" : "consecutive", how_aligned(settings));
  return result_of("RPE", title, errors, settings.alignment, series, reference_name, estimate_name);
}

std::string errors_csv(const TrajectoryErrors& errors, const ErrorSeries& series) {
  std::string text = fmt::format("first,second,stamp_s,reference_distance_m,error_{}\n", unit_of(errors));
  for (std::size_t i = 0; i < errors.errors.size(); ++i) {
    const PosePair pair = errors.pairs.empty() ? PosePair{i, i} : errors.pairs[i];
    const std::string stamp = series.stamps_s.empty() ? "" : fmt::format("{:.9f}", series.stamps_s[i]);
    text += fmt::format("{},{},{},{:.17g},{:.17g}\n", pair.first, pair.second, stamp, series.reference_distances_m[i],
                        errors.errors[i]);
  }
  return text;
}

}  // namespace trysquare
