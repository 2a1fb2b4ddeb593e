// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/internal/hilbert_order.h"

#include "trysquare/parallel/for_each_block.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace trysquare {
namespace {

constexpr std::size_t kBatch = 64;  // a fixed number, so that compilers vectorise the loops over it

using Batch = std::array<std::uint32_t, kBatch>;

/// Skilling's AxesToTranspose on kBatch points at once, without branches.
void axes_to_transpose(int bits_per_axis, Batch& x, Batch& y, Batch& z) {
  const std::uint32_t highest_bit = 1U << (bits_per_axis - 1);
  for (std::uint32_t bit = highest_bit; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    const auto exchange_or_invert = [bit, below](std::uint32_t& first, std::uint32_t& other) {
      const std::uint32_t invert = (other & bit) != 0 ? below : 0;
      const std::uint32_t exchange = (first ^ other) & (below & ~invert);
      first ^= invert | exchange;
      other ^= exchange;
    };
    for (std::size_t i = 0; i < kBatch; ++i) {
      x[i] ^= (x[i] & bit) != 0 ? below : 0;
      exchange_or_invert(x[i], y[i]);
      exchange_or_invert(x[i], z[i]);
    }
  }
  for (std::size_t i = 0; i < kBatch; ++i) {
    y[i] ^= x[i];
    z[i] ^= y[i];
    std::uint32_t parity = 0;
    for (std::uint32_t bit = highest_bit; bit > 1; bit >>= 1) parity ^= (z[i] & bit) != 0 ? bit - 1 : 0;
    x[i] ^= parity;
    y[i] ^= parity;
    z[i] ^= parity;
  }
}

/// Two zero bits after every bit.
std::uint64_t spread(std::uint64_t v) {
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  return (v | v << 2) & 0x1249249249249249ULL;
}

void hilbert_keys(PointsView points, const HilbertCube& cube, int bits_per_axis, std::uint64_t* keys) {
  const double highest_cell = (1U << bits_per_axis) - 1;
  const double exact_cells_per_m = highest_cell / cube.edge_m;
  const double cells_per_m = std::isfinite(exact_cells_per_m) ? exact_cells_per_m : 0;  // a cube without extent
  const auto cell = [&](double coordinate, double lowest) {
    return static_cast<std::uint32_t>(std::clamp((coordinate - lowest) * cells_per_m, 0.0, highest_cell));
  };
  Batch x{};
  Batch y{};
  Batch z{};
  for (std::size_t begin = 0; begin < points.size(); begin += kBatch) {
    const std::size_t count = std::min(kBatch, points.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      x[i] = cell(points[begin + i].x(), cube.lowest.x());
      y[i] = cell(points[begin + i].y(), cube.lowest.y());
      z[i] = cell(points[begin + i].z(), cube.lowest.z());
    }
    axes_to_transpose(bits_per_axis, x, y, z);
    for (std::size_t i = 0; i < count; ++i) {
      keys[begin + i] = spread(x[i]) << 2 | spread(y[i]) << 1 | spread(z[i]);
    }
  }
}

/// Least significant digit first: stable, and five times faster than a comparison sort.
void sort_by_key(int num_bits, std::vector<std::uint64_t>& keys, std::vector<std::uint32_t>& values) {
  constexpr int kDigitBits = 11;
  const int num_digits = (num_bits + kDigitBits - 1) / kDigitBits;
  constexpr std::uint64_t kDigitMask = (1U << kDigitBits) - 1;
  std::vector<std::array<std::uint32_t, 1U << kDigitBits>> histograms(static_cast<std::size_t>(num_digits));
  for (const std::uint64_t key : keys) {
    for (int digit = 0; digit < num_digits; ++digit) {
      ++histograms[static_cast<std::size_t>(digit)][(key >> (digit * kDigitBits)) & kDigitMask];
    }
  }
  std::vector<std::uint64_t> other_keys(keys.size());
  std::vector<std::uint32_t> other_values(values.size());
  for (int digit = 0; digit < num_digits; ++digit) {
    auto& next = histograms[static_cast<std::size_t>(digit)];
    if (std::find(next.begin(), next.end(), keys.size()) != next.end()) continue;  // one value only: already sorted
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::uint32_t to = next[(keys[i] >> (digit * kDigitBits)) & kDigitMask]++;
      other_keys[to] = keys[i];
      other_values[to] = values[i];
    }
    std::swap(keys, other_keys);
    std::swap(values, other_values);
  }
}

/// Cells of the length of a few spacings, if the points lie on surfaces; at most 21 bits, three of which fit a key.
int bits_per_axis_for(std::size_t num_points) {
  return std::clamp((static_cast<int>(std::bit_width(num_points)) + 1) / 2 + 2, 1, 21);
}

}  // namespace

HilbertCube hilbert_cube_around(PointsView points) {
  if (points.empty()) return {};
  Eigen::Vector3d lowest = points.front();
  Eigen::Vector3d highest = points.front();
  for (const Eigen::Vector3d& point : points) {
    lowest = lowest.cwiseMin(point);
    highest = highest.cwiseMax(point);
  }
  const double edge_m = (highest - lowest).maxCoeff();
  return {.lowest = (lowest + highest) / 2 - Eigen::Vector3d::Constant(edge_m / 2), .edge_m = edge_m};
}

std::vector<std::uint32_t> hilbert_order(PointsView points, const HilbertCube& cube, const Execution& execution) {
  constexpr std::size_t kPointsPerBlock = 1U << 14U;
  const int bits_per_axis = bits_per_axis_for(points.size());
  std::vector<std::uint64_t> keys(points.size());
  for_each_block(points.size(), kPointsPerBlock, {.num_threads = execution.num_threads}, "", [&](const Block& block) {
    hilbert_keys(points.subspan(block.begin, block.end - block.begin), cube, bits_per_axis, keys.data() + block.begin);
  });
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  sort_by_key(3 * bits_per_axis, keys, order);
  return order;
}

}  // namespace trysquare
