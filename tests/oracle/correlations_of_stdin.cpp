// SPDX-License-Identifier: Apache-2.0
// Reads "n", then n lines "x y", again and again; prints Pearson's, Spearman's and Kendall's coefficient of each.
#include "trysquare/stats/correlation.h"

#include <cstddef>
#include <cstdio>
#include <iostream>
#include <optional>
#include <vector>

int main() {
  std::size_t n = 0;
  while (std::cin >> n) {
    std::vector<double> x(n);
    std::vector<double> y(n);
    for (std::size_t i = 0; i < n; ++i) std::cin >> x[i] >> y[i];
    for (const std::optional<double>& value :
         {trysquare::pearson(x, y), trysquare::spearman(x, y), trysquare::kendall_tau_b(x, y)}) {
      std::printf("%.17g ", value.value());
    }
    std::printf("\n");
  }
  return std::cin.eof() ? 0 : 1;
}
