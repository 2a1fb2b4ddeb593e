// SPDX-License-Identifier: Apache-2.0
#include "trysquare/stats/median.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <vector>

namespace trysquare {

std::optional<double> median_of_defined(std::span<const double> values) {
  std::vector<double> defined;
  defined.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(defined),
               [](double value) { return !std::isnan(value); });
  if (defined.empty()) return std::nullopt;
  const auto middle = defined.begin() + static_cast<std::ptrdiff_t>(defined.size() / 2);
  std::nth_element(defined.begin(), middle, defined.end());
  if (defined.size() % 2 == 1) return *middle;
  return (*std::max_element(defined.begin(), middle) + *middle) / 2;
}

}  // namespace trysquare
