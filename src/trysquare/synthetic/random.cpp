// SPDX-License-Identifier: Apache-2.0
#include "trysquare/synthetic/random.h"

#include <cmath>
#include <utility>

namespace trysquare {

Random::Random(std::uint64_t seed, std::uint64_t index) : state_(seed) {
  // Neighboring seeds and indices must not meet: each passes the mixing function before it is combined.
  state_ = bits() ^ Random(~index).bits();
}

std::uint64_t Random::bits() {
  state_ += 0x9e3779b97f4a7c15u;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

double Random::uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

double Random::normal() {
  if (spare_) return *std::exchange(spare_, std::nullopt);
  for (;;) {
    const double u = 2 * uniform() - 1;
    const double v = 2 * uniform() - 1;
    const double s = u * u + v * v;
    if (s >= 1 || s == 0) continue;
    const double factor = std::sqrt(-2 * std::log(s) / s);
    spare_ = v * factor;
    return u * factor;
  }
}

Eigen::Vector3d Random::normal_vector() {
  const double x = normal();  // one after the other: the order of arguments of a call is not fixed
  const double y = normal();
  const double z = normal();
  return {x, y, z};
}

Eigen::Vector3d Random::unit_direction() { return normal_vector().normalized(); }

}  // namespace trysquare
