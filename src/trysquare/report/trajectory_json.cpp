// SPDX-License-Identifier: Apache-2.0
#include "trysquare/report/trajectory_json.h"

#include "trysquare/report/internal/json.h"
#include "trysquare/report/internal/statistics_json.h"

namespace trysquare {
namespace {

using internal::Json;

/// What APE and RPE have in common.
Json common_json(const char* metric, const TrajectoryErrors& errors, Alignment alignment,
                 std::size_t num_poses_to_align, const TrajectoryErrorsFacts& facts) {
  Json json = {{"schema", "trysquare.trajectory/1"}, {"version", facts.version}, {"metric", metric}};
  json["inputs"] = {{"reference", facts.reference},
                    {"estimate", facts.estimate},
                    {"num_associated", facts.num_associated},
                    {"num_unmatched_reference", facts.num_unmatched_reference},
                    {"num_unmatched_estimate", facts.num_unmatched_estimate}};
  json["settings"] = {{"pose_relation", name_of(errors.relation)},
                      {"alignment", name_of(alignment)},
                      {"num_poses_to_align", num_poses_to_align}};
  json["unit"] = unit_of(errors.relation);
  json["num_pairs"] = errors.errors.size();
  if (errors.errors.empty()) {
    json["statistics"] = nullptr;
    json["scale"] = nullptr;
    json["reason"] = facts.reason;
    return json;
  }
  json["statistics"] = Json::object();
  internal::set_statistics(json["statistics"], errors.statistics);
  json["scale"] = errors.reference_from_estimate.scale;
  return json;
}

}  // namespace

std::string to_json(const TrajectoryErrors& errors, const ApeSettings& settings, const TrajectoryErrorsFacts& facts) {
  return internal::dump(common_json("ape", errors, settings.alignment, settings.num_poses_to_align, facts));
}

std::string to_json(const TrajectoryErrors& errors, const RpeSettings& settings, const TrajectoryErrorsFacts& facts) {
  Json json = common_json("rpe", errors, settings.alignment, settings.num_poses_to_align, facts);
  json["settings"]["delta"] = settings.pairs.delta;
  json["settings"]["delta_unit"] = name_of(settings.pairs.unit);
  json["settings"]["delta_tolerance"] = settings.pairs.relative_tolerance;
  json["settings"]["all_pairs"] = settings.pairs.all_pairs;
  json["settings"]["pairs_from_reference"] = settings.pairs_from_reference;
  return internal::dump(json);
}

}  // namespace trysquare
