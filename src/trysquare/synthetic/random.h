// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <optional>

namespace trysquare {

/// A stream of random numbers that is the same on every platform: the standard distributions differ between libraries.
///
/// Source:  Steele, Lea & Flood, Fast splittable pseudorandom number generators (SplitMix64), 2014.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// A stream of its own for item `index` of an experiment with `seed`: what one item draws does not move the others.
  Random(std::uint64_t seed, std::uint64_t index);

  std::uint64_t bits();              ///< 64 uniform bits.
  double uniform();                  ///< In [0, 1), multiples of 2⁻⁵³.
  double normal();                   ///< Mean 0, standard deviation 1 (Marsaglia's polar method).
  Eigen::Vector3d normal_vector();   ///< Three independent normal().
  Eigen::Vector3d unit_direction();  ///< Uniform on the sphere.

 private:
  std::uint64_t state_;
  std::optional<double> spare_;  ///< The polar method makes two values at a time.
};

}  // namespace trysquare
