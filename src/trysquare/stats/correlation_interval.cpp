// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/correlation_interval.h"

#include "trysquare/core/error.h"
#include "trysquare/stats/correlation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

namespace trysquare {
namespace {

void require_confidence(double confidence) {
  if (confidence > 0 && confidence < 1) return;
  throw InvalidArgument(fmt::format("confidence = {} is out of range: it must be in (0, 1)", confidence));
}

/// z with P(|Z| < z) = confidence for a standard normal Z: by bisection, erf is monotone.
double normal_half_width(double confidence) {
  double low = 0;
  double high = 40;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = (low + high) / 2;
    (std::erf(middle / std::numbers::sqrt2) < confidence ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// Variance of atanh(value) times (num_pairs − lost), and `lost`.
struct FisherVariance {
  double numerator = 1;
  std::size_t lost = 3;
};

FisherVariance fisher_variance(Coefficient coefficient, double value) {
  switch (coefficient) {
    case Coefficient::kPearson:
      break;
    case Coefficient::kSpearman:
      return {1 + value * value / 2, 3};
    case Coefficient::kKendallTauB:
      return {0.437, 4};
  }
  return {1, 3};
}

/// Uniform in 0 … count − 1. The engine is the same on every platform, the standard's distributions are not.
std::size_t draw(std::mt19937_64& engine, std::size_t count) {
  const double share = static_cast<double>(engine() >> 11) * 0x1p-53;
  return std::min(static_cast<std::size_t>(share * static_cast<double>(count)), count - 1);
}

/// The middle `confidence` of some numbers, by linear interpolation between them.
Interval middle_of(std::vector<double> values, double confidence) {
  std::sort(values.begin(), values.end());
  const auto quantile = [&](double share) {
    const double place = share * static_cast<double>(values.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    return std::lerp(values[below], values[above], place - static_cast<double>(below));
  };
  return {quantile((1 - confidence) / 2), quantile((1 + confidence) / 2)};
}

/// @param statistic  Of the items whose indices it is given; nullopt: the resample is left out.
std::optional<Interval> bootstrap(std::size_t num_items, const BootstrapSettings& settings,
                                  const std::function<std::optional<double>(std::span<const std::size_t>)>& statistic) {
  std::mt19937_64 engine(settings.seed);
  std::vector<std::size_t> drawn(num_items);
  std::vector<double> values;
  for (std::size_t k = 0; k < settings.num_resamples; ++k) {
    for (std::size_t& item : drawn) item = draw(engine, num_items);
    if (const std::optional<double> value = statistic(drawn)) values.push_back(*value);
  }
  if (values.empty()) return std::nullopt;
  return middle_of(std::move(values), settings.confidence);
}

}  // namespace

std::string_view name_of(Coefficient coefficient) {
  switch (coefficient) {
    case Coefficient::kPearson:
      return "pearson";
    case Coefficient::kSpearman:
      return "spearman";
    case Coefficient::kKendallTauB:
      break;
  }
  return "kendall";
}

std::optional<double> correlation(Coefficient coefficient, std::span<const double> x, std::span<const double> y) {
  switch (coefficient) {
    case Coefficient::kPearson:
      return pearson(x, y);
    case Coefficient::kSpearman:
      return spearman(x, y);
    case Coefficient::kKendallTauB:
      break;
  }
  return kendall_tau_b(x, y);
}

std::optional<Interval> fisher_interval(Coefficient coefficient, double value, std::size_t num_pairs,
                                        double confidence) {
  require_confidence(confidence);
  if (!(std::abs(value) <= 1)) {
    throw InvalidArgument(fmt::format("value = {} is out of range: a correlation is in [-1, 1]", value));
  }
  const FisherVariance variance = fisher_variance(coefficient, value);
  if (num_pairs <= variance.lost) return std::nullopt;
  if (std::abs(value) == 1) return Interval{value, value};
  const double half_width =
      normal_half_width(confidence) * std::sqrt(variance.numerator / static_cast<double>(num_pairs - variance.lost));
  return Interval{std::tanh(std::atanh(value) - half_width), std::tanh(std::atanh(value) + half_width)};
}

void BootstrapSettings::validate() const {
  require_confidence(confidence);
  if (num_resamples < 20) {
    throw InvalidArgument(fmt::format("num_resamples = {} is out of range: it must be >= 20", num_resamples));
  }
}

std::optional<Interval> bootstrap_interval(Coefficient coefficient, std::span<const double> x,
                                           std::span<const double> y, const BootstrapSettings& settings) {
  settings.validate();
  if (!correlation(coefficient, x, y)) return std::nullopt;
  std::vector<double> some_x(x.size());
  std::vector<double> some_y(y.size());
  return bootstrap(x.size(), settings, [&](std::span<const std::size_t> drawn) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      some_x[i] = x[drawn[i]];
      some_y[i] = y[drawn[i]];
    }
    return correlation(coefficient, some_x, some_y);
  });
}

std::optional<Interval> bootstrap_interval_of_mean(std::span<const double> values, const BootstrapSettings& settings) {
  settings.validate();
  if (values.size() < 2) return std::nullopt;
  return bootstrap(values.size(), settings, [&](std::span<const std::size_t> drawn) -> std::optional<double> {
    double sum = 0;
    for (const std::size_t item : drawn) sum += values[item];
    return sum / static_cast<double>(drawn.size());
  });
}

}  // namespace trysquare
