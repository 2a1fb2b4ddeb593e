// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/paired_test.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace trysquare {
namespace {

constexpr std::size_t kMostBlocks = 16;  ///< 2^15 combinations of signs: p-values down to 3e-5, in microseconds.

/// Consecutive differences that flip as one.
struct FlippedBlock {
  double sum = 0;
  double count = 0;
};

std::vector<FlippedBlock> blocks_of(std::span<const double> differences) {
  const std::size_t num_blocks = std::min(differences.size(), kMostBlocks);
  std::vector<FlippedBlock> blocks(num_blocks);
  for (std::size_t i = 0; i < differences.size(); ++i) {
    FlippedBlock& block = blocks[i * num_blocks / differences.size()];
    block.sum += differences[i];
    block.count += 1;
  }
  return blocks;
}

/// Share of the sign combinations whose sum is at least as far from zero as the observed one, were the mean `mean`.
/// A combination and its opposite are equally far: the first block keeps its sign.
double share_as_extreme(const std::vector<FlippedBlock>& blocks, double mean) {
  std::vector<double> values;
  double magnitude = 0;
  for (const FlippedBlock& block : blocks) {
    values.push_back(block.sum - mean * block.count);
    magnitude += std::abs(values.back());
  }
  double sum = std::accumulate(values.begin(), values.end(), 0.0);
  const double observed = std::abs(sum) - 1e-9 * magnitude;  // equal sums must count as equal, whatever the rounding
  const std::uint32_t num_combinations = std::uint32_t{1} << (blocks.size() - 1);
  std::uint32_t num_extreme = 1;  // the observed one
  std::vector<double> sign(values.size(), 1);
  for (std::uint32_t step = 1; step < num_combinations; ++step) {  // Gray code: one sign changes from step to step
    const auto flipped = static_cast<std::size_t>(std::countr_zero(step)) + 1;
    sum -= 2 * sign[flipped] * values[flipped];
    sign[flipped] = -sign[flipped];
    num_extreme += std::abs(sum) >= observed ? 1U : 0U;
  }
  return static_cast<double>(num_extreme) / num_combinations;
}

/// The end of the interval on the side of `far`, which is excluded while `mean` is not.
double end_of_interval(const std::vector<FlippedBlock>& blocks, double mean, double far, double alpha) {
  double inside = mean;
  double outside = far;
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = inside + (outside - inside) / 2;
    (share_as_extreme(blocks, middle) > alpha ? inside : outside) = middle;
  }
  return outside;
}

std::optional<Interval> interval_of(const std::vector<FlippedBlock>& blocks, double mean, double confidence) {
  const double alpha = 1 - confidence;
  if (least_p_value(blocks.size()) > alpha) return std::nullopt;
  // Beyond the largest deviation of a block all blocks lie on one side, and no combination is as extreme.
  double reach = 0;
  for (const FlippedBlock& block : blocks) reach = std::max(reach, std::abs(block.sum / block.count - mean));
  if (reach == 0) return Interval{mean, mean};
  return Interval{end_of_interval(blocks, mean, mean - 1.001 * reach, alpha),
                  end_of_interval(blocks, mean, mean + 1.001 * reach, alpha)};
}

}  // namespace

PairedTest paired_test(std::span<const double> differences, double confidence) {
  if (differences.empty()) throw InvalidArgument("a paired test needs at least one pair");
  if (!(confidence > 0 && confidence < 1)) {
    throw InvalidArgument(fmt::format("confidence = {} is out of range: it must be in (0, 1)", confidence));
  }
  for (const double each : differences) {
    if (!std::isfinite(each)) throw InvalidArgument("a paired test needs finite differences");
  }
  const std::vector<FlippedBlock> blocks = blocks_of(differences);
  PairedTest result{.num_blocks = blocks.size()};
  result.mean = std::accumulate(differences.begin(), differences.end(), 0.0) / static_cast<double>(differences.size());
  result.p_value = share_as_extreme(blocks, 0);
  result.interval = interval_of(blocks, result.mean, confidence);
  return result;
}

double least_p_value(std::size_t num_differences) {
  return std::ldexp(1.0, 1 - static_cast<int>(std::min(num_differences, kMostBlocks)));
}

std::vector<double> holm_adjusted(std::span<const double> p_values) {
  std::vector<std::size_t> order(p_values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return p_values[a] < p_values[b]; });
  std::vector<double> adjusted(p_values.size());
  double largest = 0;
  for (std::size_t rank = 0; rank < order.size(); ++rank) {
    const auto num_left = static_cast<double>(order.size() - rank);
    largest = std::max(largest, std::min(1.0, num_left * p_values[order[rank]]));
    adjusted[order[rank]] = largest;
  }
  return adjusted;
}

}  // namespace trysquare
