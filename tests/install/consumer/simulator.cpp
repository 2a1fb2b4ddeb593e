// SPDX-License-Identifier: Apache-2.0
// The library that needs Embree.
#include "trysquare/simulation/ray_caster.h"

#include <cstdio>

int main() {
  const trysquare::RayCaster caster({{{2, -1, -1}, {2, 1, -1}, {2, 0, 2}}, {{0, 1, 2}}});
  std::printf("range_m %.12f\n", caster.cast({{0, 0, 0}, {1, 0, 0}}));
  return 0;
}
