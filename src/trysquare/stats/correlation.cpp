// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/correlation.h"

#include "trysquare/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace trysquare {
namespace {

void validate(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size()) {
    throw InvalidArgument(
        fmt::format("x has {} values and y {}: a correlation needs equally many", x.size(), y.size()));
  }
  const auto finite = [](double value) { return std::isfinite(value); };
  if (std::all_of(x.begin(), x.end(), finite) && std::all_of(y.begin(), y.end(), finite)) return;
  throw InvalidArgument("x or y has a value that is not finite");
}

bool varies(std::span<const double> values) {
  return std::any_of(values.begin(), values.end(), [&](double value) { return value != values.front(); });
}

/// Deviations from the mean over the largest one, so that no square of theirs under- or overflows. The values are
/// brought to the size of 1 by a power of two first, which loses no digits and keeps their sum finite.
std::vector<double> scaled_deviations(std::span<const double> values) {
  double size = 0;
  for (const double value : values) size = std::max(size, std::abs(value));
  const int exponent = std::ilogb(size);
  std::vector<double> result;
  result.reserve(values.size());
  for (const double value : values) result.push_back(std::scalbn(value, -exponent));
  // Twice: the sum of many large numbers is not accurate, and what it is off is the mean of the deviations.
  for (int pass = 0; pass < 2; ++pass) {
    const double mean = std::accumulate(result.begin(), result.end(), 0.0) / static_cast<double>(result.size());
    for (double& value : result) value -= mean;
  }
  double largest = 0;
  for (const double value : result) largest = std::max(largest, std::abs(value));
  for (double& value : result) value /= largest;
  return result;
}

std::vector<std::size_t> ascending(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

/// Ranks 0 … n − 1; equal values share the mean of theirs.
std::vector<double> average_ranks(std::span<const double> values) {
  const std::vector<std::size_t> order = ascending(values);
  std::vector<double> ranks(values.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && values[order[end]] == values[order[begin]]) ++end;
    for (std::size_t k = begin; k < end; ++k) ranks[order[k]] = static_cast<double>(begin + end - 1) / 2;
    begin = end;
  }
  return ranks;
}

std::int64_t num_pairs(std::size_t n) { return static_cast<std::int64_t>(n) * (static_cast<std::int64_t>(n) - 1) / 2; }

/// Pairs within runs of neighbors that are the same.
template <typename Same>
std::int64_t num_pairs_in_runs(std::size_t n, Same same) {
  std::int64_t count = 0;
  for (std::size_t begin = 0, i = 1; i <= n; ++i) {
    if (i < n && same(begin, i)) continue;
    count += num_pairs(i - begin);
    begin = i;
  }
  return count;
}

/// Sorts `values` and returns how many pairs stood in descending order.
std::int64_t sort_counting_inversions(std::span<double> values, std::span<double> buffer) {
  if (values.size() < 2) return 0;
  const std::size_t half = values.size() / 2;
  std::int64_t count = sort_counting_inversions(values.first(half), buffer.first(half)) +
                       sort_counting_inversions(values.subspan(half), buffer.subspan(half));
  std::size_t left = 0;
  std::size_t right = half;
  for (double& out : buffer) {
    const bool take_left = right == values.size() || (left < half && values[left] <= values[right]);
    if (!take_left) count += static_cast<std::int64_t>(half - left);
    out = take_left ? values[left++] : values[right++];
  }
  std::copy(buffer.begin(), buffer.end(), values.begin());
  return count;
}

}  // namespace

std::optional<double> pearson(std::span<const double> x, std::span<const double> y) {
  validate(x, y);
  if (!varies(x) || !varies(y)) return std::nullopt;
  const std::vector<double> dx = scaled_deviations(x);
  const std::vector<double> dy = scaled_deviations(y);
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for (std::size_t i = 0; i < dx.size(); ++i) {
    xx += dx[i] * dx[i];
    yy += dy[i] * dy[i];
    xy += dx[i] * dy[i];
  }
  return std::clamp(xy / (std::sqrt(xx) * std::sqrt(yy)), -1.0, 1.0);
}

std::optional<double> spearman(std::span<const double> x, std::span<const double> y) {
  validate(x, y);
  return pearson(average_ranks(x), average_ranks(y));
}

std::optional<double> kendall_tau_b(std::span<const double> x, std::span<const double> y) {
  validate(x, y);
  if (!varies(x) || !varies(y)) return std::nullopt;
  const std::size_t n = x.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return x[a] != x[b] ? x[a] < x[b] : y[a] < y[b]; });
  const std::int64_t tied_in_x = num_pairs_in_runs(n, [&](auto a, auto b) { return x[order[a]] == x[order[b]]; });
  const std::int64_t tied_in_both =
      num_pairs_in_runs(n, [&](auto a, auto b) { return x[order[a]] == x[order[b]] && y[order[a]] == y[order[b]]; });
  std::vector<double> y_by_x;
  y_by_x.reserve(n);
  for (const std::size_t i : order) y_by_x.push_back(y[i]);
  std::vector<double> buffer(n);
  const std::int64_t discordant = sort_counting_inversions(y_by_x, buffer);
  const std::int64_t tied_in_y = num_pairs_in_runs(n, [&](auto a, auto b) { return y_by_x[a] == y_by_x[b]; });
  const std::int64_t all = num_pairs(n);
  const std::int64_t concordant_minus_discordant = all - tied_in_x - tied_in_y + tied_in_both - 2 * discordant;
  const double tau = static_cast<double>(concordant_minus_discordant) /
                     std::sqrt(static_cast<double>(all - tied_in_x)) / std::sqrt(static_cast<double>(all - tied_in_y));
  return std::clamp(tau, -1.0, 1.0);
}

}  // namespace trysquare
