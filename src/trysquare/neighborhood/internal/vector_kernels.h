// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/internal/moment_row.h"
#include "trysquare/neighborhood/internal/packed_points.h"
#include "trysquare/neighborhood/internal/packed_tree.h"
#include "trysquare/neighborhood/internal/scan_sets.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trysquare {

/// Consecutive packed queries that are near each other and share one walk through the map's tree.
struct SuperGroup {
  static constexpr std::size_t kMaxQueries = 1024;
  static constexpr std::size_t kGroupSize = 16;  ///< Queries that share the tests of boxes.
  static constexpr std::size_t kMaxGroups = kMaxQueries / kGroupSize;

  std::size_t first_query = 0;
  std::size_t num_queries = 0;  ///< 1 … kMaxQueries

  std::size_t num_groups() const { return (num_queries + kGroupSize - 1) / kGroupSize; }
};

/// Two squared radii around the true one: a squared distance in single precision that is below `sure` or not below
/// `maybe` is decided; what lies between is looked at again in double precision.
struct GuardBand {
  float sure = 0;
  float maybe = 0;
};

/// The engine's working memory, one a thread: about 0.2 MB. Sums are about `center`.
struct BallScratch {
  using Floats = std::array<float, SuperGroup::kMaxQueries>;
  using GroupFloats = std::array<float, SuperGroup::kMaxGroups>;

  explicit BallScratch(std::size_t num_scans) : scans(num_scans) {}

  // The frame of the super-group.
  Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< In the map frame [m].
  std::array<float, 3> center_from_origin{};
  std::array<float, 3> lo{};  ///< Box of all queries, about the map's origin.
  std::array<float, 3> hi{};
  GuardBand squared_radius;

  // Its queries and what is known of their neighborhoods.
  alignas(64) std::array<Floats, 3> queries;        ///< About `center`; padded to whole groups with the last query.
  alignas(64) std::array<GroupFloats, 3> group_lo;  ///< About the map's origin.
  alignas(64) std::array<GroupFloats, 3> group_hi;
  MomentRow sums_of_all;
  std::array<MomentRow, SuperGroup::kMaxGroups> sums_of_group;
  using PaddedRow = std::array<double, 16>;  ///< A MomentRow that fills whole lines of the cache.
  alignas(64) std::array<PaddedRow, SuperGroup::kMaxQueries> query_sums;
  ScanSets scans;

  // The leaf at hand: 16 points about `center`, and the sums over every subset of its four quarters: entry [q][m] is
  // the sum over the points 4q + i for which bit i of m is set.
  alignas(64) std::array<std::array<float, 16>, 3> points;
  alignas(64) std::array<std::array<PaddedRow, 16>, 4> subset_sums;
  using Numbers = std::array<std::uint32_t, SuperGroup::kMaxQueries + SuperGroup::kGroupSize>;  // written by vectors
  Numbers inside;    ///< Queries whose ball holds the whole leaf,
  Numbers crossing;  ///< … and those whose ball may hold some of it.
  std::array<std::uint16_t, SuperGroup::kMaxQueries> points_of_crossing;  ///< One bit a point that it holds.
  std::size_t num_inside = 0;
  std::size_t num_crossing = 0;

  struct Node {
    std::uint32_t level;
    std::uint32_t index;
  };
  std::vector<Node> stack;
};

/// The hot loops, compiled for one instruction set.
struct VectorKernels {
  const char* name;  ///< "AVX3", "AVX2", ..., "SCALAR": Highway's names of the instruction sets.

  /// Adds up the neighborhoods of one super-group in `scratch`, which start_super_group() has prepared.
  void (*add_balls)(const PointIndex::Tree& map, const PackedPoints& queries, double radius_m,
                    const SuperGroup& super_group, BallScratch& scratch);

  /// See eigenvalues().
  void (*eigenvalues)(std::span<const Moments> moments, std::span<Eigen::Vector3d> eigenvalues);
};

/// Those that this processor can run, the fastest first; the last one runs on all processors of its family.
/// A constant: what the processor can do is asked once, because asking is slow.
const std::vector<VectorKernels>& vector_kernels();

/// The point about which the sums of a super-group are: the middle of its box, not far from any of its queries.
Eigen::Vector3d center_of(const PackedPoints& queries, const SuperGroup& super_group);

/// Chooses the frame and puts the queries into it.
void start_super_group(const PointIndex::Tree& map, const PackedPoints& queries, double radius_m,
                       const SuperGroup& super_group, BallScratch& scratch);

/// The sums over the neighborhood of one query of the super-group, about `scratch.center`.
MomentRow sums_of_query(const BallScratch& scratch, std::size_t query);

}  // namespace trysquare
