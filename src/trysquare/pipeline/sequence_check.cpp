// SPDX-License-Identifier: Apache-2.0
#include "trysquare/pipeline/sequence_check.h"

#include "trysquare/parallel/for_each_block.h"
#include "trysquare/stats/median.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <utility>

namespace trysquare {
namespace {

constexpr double kGapInSteps = 1.7;
constexpr std::size_t kFewestSteps = 4;
constexpr double kShareOfEqualSteps = 0.7;  ///< Numbers whose steps differ more often count something else.
constexpr std::size_t kStepsAround = 5;     ///< On either side of a step of the way.
constexpr double kSteadiness = 0.2;         ///< Of those the farthest from their median, as a share of it.

/// FNV-1a over whole words.
std::uint64_t digest_of(const Scan& scan) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const Eigen::Vector3d& point : scan.points_in_scan) {
    for (int axis = 0; axis < 3; ++axis) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(point[axis])) * 1099511628211ULL;
      hash ^= hash >> 32;
    }
  }
  return hash;
}

double usual(const std::vector<double>& steps) { return median_of_defined(steps).value_or(0); }

/// Steps that are kGapInSteps usual ones or longer.
std::vector<std::size_t> long_steps(const std::vector<double>& steps) {
  std::vector<std::size_t> found;
  const double usual_step = usual(steps);
  for (std::size_t i = 0; i < steps.size() && usual_step > 0; ++i) {
    if (steps[i] >= kGapInSteps * usual_step) found.push_back(i);
  }
  return found;
}

/// The number that the name of a file ends with, before its extension; nothing when it has none.
std::optional<double> number_at_end(const std::string& name) {
  const std::string stem = std::filesystem::path(name).stem().string();
  const std::size_t last_other = stem.find_last_not_of("0123456789");
  const std::string digits = last_other == std::string::npos ? stem : stem.substr(last_other + 1);
  constexpr std::size_t kMostDigits = 15;  // a double holds them
  if (digits.empty() || digits.size() > kMostDigits) return std::nullopt;
  return std::stod(digits);
}

std::vector<double> differences(const std::vector<double>& values) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < values.size(); ++i) steps.push_back(values[i] - values[i - 1]);
  return steps;
}

/// Steps from number to number; empty where names have none, or these do not count scans.
std::vector<double> steps_of_names(const std::vector<ScanIdentity>& scans) {
  std::vector<double> numbers;
  for (const ScanIdentity& scan : scans) {
    const std::optional<double> number = number_at_end(scan.name);
    if (!number) return {};
    numbers.push_back(*number);
  }
  std::vector<double> steps = differences(numbers);
  const double usual_step = usual(steps);
  const auto num_equal = static_cast<double>(std::count(steps.begin(), steps.end(), usual_step));
  if (!(usual_step > 0) || num_equal < kShareOfEqualSteps * static_cast<double>(steps.size())) return {};
  return steps;
}

/// The ways between poses that are long although those around them are steady.
std::vector<std::size_t> long_ways(const std::vector<double>& ways_m) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < ways_m.size(); ++i) {
    std::vector<double> around;
    for (std::size_t j = i - std::min(i, kStepsAround); j < std::min(ways_m.size(), i + kStepsAround + 1); ++j) {
      if (j != i) around.push_back(ways_m[j]);
    }
    const double usual_m = usual(around);
    const auto is_steady = [&](double way_m) { return std::abs(way_m - usual_m) <= kSteadiness * usual_m; };
    if (around.size() >= kFewestSteps && usual_m > 0 && ways_m[i] >= kGapInSteps * usual_m &&
        std::all_of(around.begin(), around.end(), is_steady)) {
      found.push_back(i);
    }
  }
  return found;
}

std::optional<Finding> finding_of(const std::vector<std::size_t>& gaps, const std::vector<double>& steps,
                                  const std::string& of_what, const std::string& unit, Severity severity) {
  if (gaps.empty()) return std::nullopt;
  const double usual_step = usual(steps);
  const double limit = kGapInSteps * usual_step;
  const double first = steps[gaps.front()];
  const std::string space = unit.empty() ? "" : " ";
  return Finding{
      .id = "missing_scans",
      .severity = severity,
      .message =
          fmt::format("{} gap{} in the {}, first between scans {} and {}: {:.4g}{}{}, where {:.4g}{}{} are usual "
                      "(limit {:.4g})",
                      gaps.size(), gaps.size() == 1 ? "" : "s", of_what, gaps.front(), gaps.front() + 1, first, space,
                      unit, usual_step, space, unit, limit),
      .remedy = "look for the scans that are missing; if poses are given in order, see that each scan has its own",
      .evidence = Evidence{first, limit, unit}};
}

}  // namespace

std::vector<ScanIdentity> identify_scans(const ScanSequence& scans, const Execution& execution) {
  std::vector<ScanIdentity> result(scans.size());
  for_each_block(scans.size(), 1, execution, "scans", [&](const Block& block) {
    const Scan scan = scans.load(block.index);
    result[block.index] = {.num_points = scan.points_in_scan.size(),
                           .digest = digest_of(scan),
                           .stamp_ns = scan.stamp_ns,
                           .name = scans.name(block.index)};
  });
  return result;
}

std::optional<Finding> check_duplicates(const std::vector<ScanIdentity>& scans) {
  std::map<std::pair<std::size_t, std::uint64_t>, std::size_t> first_with;
  std::size_t num_repeated = 0;
  std::string first_two;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (scans[i].num_points == 0) continue;
    const auto [first, is_new] = first_with.emplace(std::pair(scans[i].num_points, scans[i].digest), i);
    if (is_new) continue;
    if (num_repeated++ == 0) first_two = fmt::format("{} and {}", first->second, i);
  }
  if (num_repeated == 0) return std::nullopt;
  return Finding{.id = "duplicate_scans",
                 .severity = Severity::kWarning,
                 .message = fmt::format("{} of {} scans repeat{} the points of an earlier one, first {} (limit 0)",
                                        num_repeated, scans.size(), num_repeated == 1 ? "s" : "", first_two),
                 .remedy = "leave the copies out: their points prove nothing, and their poses cannot both be right",
                 .evidence = Evidence{static_cast<double>(num_repeated), 0, "scans"}};
}

std::optional<Finding> check_gaps(const std::vector<ScanIdentity>& scans, const std::vector<std::int64_t>& stamps_ns,
                                  const Trajectory& trajectory) {
  if (scans.size() <= kFewestSteps) return std::nullopt;
  if (!stamps_ns.empty()) {
    std::vector<double> times_s;
    for (const std::int64_t stamp_ns : stamps_ns) {
      times_s.push_back(1e-9 * static_cast<double>(stamp_ns - stamps_ns.front()));
    }
    const std::vector<double> steps_s = differences(times_s);
    return finding_of(long_steps(steps_s), steps_s, "time stamps", "s", Severity::kWarning);
  }
  if (const std::vector<double> steps = steps_of_names(scans); !steps.empty()) {
    return finding_of(long_steps(steps), steps, "numbers of the scans", "", Severity::kWarning);
  }
  std::vector<double> ways_m;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    ways_m.push_back(
        (trajectory.world_from_scan[i].translation - trajectory.world_from_scan[i - 1].translation).norm());
  }
  return finding_of(long_ways(ways_m), ways_m, "way between poses", "m", Severity::kNote);
}

}  // namespace trysquare
