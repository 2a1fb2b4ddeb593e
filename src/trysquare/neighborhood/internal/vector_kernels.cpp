// SPDX-License-Identifier: Apache-2.0
// Compiled once for every instruction set: Highway includes this file again and again.
#include "trysquare/neighborhood/internal/vector_kernels.h"

#include "trysquare/neighborhood/internal/points_within.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>

#undef HWY_TARGET_INCLUDE
// The instruction sets that pay. Without those whose vectors have no size known to the compiler.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#define HWY_TARGET_INCLUDE "trysquare/neighborhood/internal/vector_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace trysquare::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tree = PointIndex::Tree;
constexpr std::size_t kGroup = SuperGroup::kGroupSize;
constexpr std::size_t kLeaf = PackedPoints::kLeafSize;

/// One bit a lane, lowest lane first.
template <class D, class Mask>
HWY_INLINE std::uint32_t bits_of(D d, Mask mask) {
  alignas(8) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(d, mask, bytes);
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, sizeof(bits));
  return bits & ((1U << hn::Lanes(d)) - 1U);
}

/// Which of up to 64 boxes lie wholly inside the balls, and which cross their surfaces.
struct Relation {
  std::uint64_t inside = 0;
  std::uint64_t crossing = 0;
};

/// Every ball around a point of one box against `count` other boxes; which of the two holds the queries does not
/// matter. Lanes are the other boxes: calls hear(i, inside, crossing) with a mask each for the boxes from i on.
template <class D, class Hear>
HWY_INLINE void relate(D d, const std::array<float, 3>& lo, const std::array<float, 3>& hi,
                       const std::array<const float*, 3>& other_lo, const std::array<const float*, 3>& other_hi,
                       std::size_t count, const GuardBand& squared_radius, const Hear& hear) {
  const auto sure = hn::Set(d, squared_radius.sure);
  const auto maybe = hn::Set(d, squared_radius.maybe);
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    auto nearest = hn::Zero(d);
    auto farthest = hn::Zero(d);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto l = hn::LoadU(d, other_lo[axis] + i);
      const auto h = hn::LoadU(d, other_hi[axis] + i);
      const auto above = hn::Sub(l, hn::Set(d, hi[axis]));
      const auto below = hn::Sub(hn::Set(d, lo[axis]), h);
      const auto gap = hn::Max(hn::Max(above, below), hn::Zero(d));
      nearest = hn::MulAdd(gap, gap, nearest);
      const auto span = hn::Min(above, below);  // negative; it is squared
      farthest = hn::MulAdd(span, span, farthest);
    }
    const auto inside = hn::Lt(farthest, sure);
    hear(i, inside, hn::AndNot(inside, hn::Lt(nearest, maybe)));
  }
}

/// The same for up to 64 boxes, one bit each.
template <std::size_t kLanes>
HWY_INLINE Relation relation_of(const std::array<float, 3>& lo, const std::array<float, 3>& hi,
                                const std::array<const float*, 3>& other_lo,
                                const std::array<const float*, 3>& other_hi, std::size_t count,
                                const GuardBand& squared_radius) {
  const hn::CappedTag<float, kLanes> d;
  Relation relation;
  relate(d, lo, hi, other_lo, other_hi, count, squared_radius, [&](std::size_t i, auto inside, auto crossing) HWY_ATTR {
    relation.inside |= std::uint64_t{bits_of(d, inside)} << i;
    relation.crossing |= std::uint64_t{bits_of(d, crossing)} << i;
  });
  return relation;
}

/// Calls each(d, i) for the vectors that make up the ten sums of a row: from element i on as many as `d` has lanes.
template <class Each>
HWY_INLINE void for_vectors_of_row(const Each& each) {
  const hn::CappedTag<double, 8> d;
  for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) each(d, i);
  const hn::CappedTag<double, 2> rest;
  for (std::size_t i = 8; i < MomentRow::kSize; i += hn::Lanes(rest)) each(rest, i);
}

/// The points of a leaf, as vectors of coordinates about the center.
struct LeafVectors {
  using D = hn::CappedTag<float, kLeaf>;
  static constexpr std::size_t kCount = kLeaf / hn::MaxLanes(D());
  hn::Vec<D> x[kCount];
  hn::Vec<D> y[kCount];
  hn::Vec<D> z[kCount];
};

/// What one super-group meets on its walk through the tree.
class Walk {
 public:
  Walk(const Tree& map, const PackedPoints& queries, double radius_m, const SuperGroup& super_group,
       BallScratch& scratch)
      : map_(map),
        queries_(queries),
        squared_radius_(radius_m * radius_m),
        super_group_(super_group),
        num_groups_(super_group.num_groups()),
        s_(scratch) {}

  void run() {
    s_.stack.clear();
    if (map_.top_level() == 1) return visit_block(0);
    s_.stack.push_back({static_cast<std::uint32_t>(map_.top_level()), 0});
    while (!s_.stack.empty()) {
      const BallScratch::Node node = s_.stack.back();
      s_.stack.pop_back();
      visit_children(node.level - 1, node.index * Tree::kFanOut);
    }
  }

 private:
  /// Eight siblings above the leaves against the box of all queries.
  void visit_children(std::size_t level, std::size_t first) {
    const Boxes& boxes = map_.boxes_of(level);
    Relation relation = relation_of<8>(s_.lo, s_.hi, pointers(boxes.lo, first), pointers(boxes.hi, first),
                                       Tree::kFanOut, s_.squared_radius);
    for (; relation.inside != 0; relation.inside &= relation.inside - 1) {
      add_to_all(level, first + static_cast<std::size_t>(std::countr_zero(relation.inside)));
    }
    for (; relation.crossing != 0; relation.crossing &= relation.crossing - 1) {
      const std::size_t node = first + static_cast<std::size_t>(std::countr_zero(relation.crossing));
      if (level == 1) {
        visit_block(node);
      } else {
        s_.stack.push_back({static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(node)});
      }
    }
  }

  /// A node above eight leaves against the boxes of the groups, then its leaves.
  void visit_block(std::size_t node) {
    Relation relation = relate_to_groups(1, node);
    if (relation.inside != 0) add_to_groups(relation.inside, node);
    if (relation.crossing == 0) return;
    const std::size_t first = node * Tree::kFanOut;
    const std::size_t end = std::min(first + Tree::kFanOut, map_.packed.num_leaves());
    for (std::size_t leaf = first; leaf < end; ++leaf) visit_leaf(leaf, relation.crossing);
  }

  void visit_leaf(std::size_t leaf, std::uint64_t groups) {
    Relation relation = relate_to_groups(0, leaf);
    relation.inside &= groups;
    relation.crossing &= groups;
    relate_to_queries(leaf, relation.crossing);
    if (relation.inside == 0 && s_.num_inside == 0 && s_.num_crossing == 0) return;
    // Sums over all subsets pay when there are some queries to look them up.
    constexpr std::size_t kWorthTheSubsets = 5;
    const bool has_subset_sums = s_.num_crossing >= kWorthTheSubsets;
    load_points(leaf);
    if (has_subset_sums) add_up_subsets();
    if (map_.has_scans()) {
      s_.scans.set_leaf(std::span(map_.scans).subspan(leaf * kLeaf, map_.packed.points_in_leaf(leaf)));
    }
    if (relation.inside != 0 || s_.num_inside != 0) {
      add_whole_leaf(sum_of_leaf(has_subset_sums, map_.packed.points_in_leaf(leaf)), relation.inside);
    }
    find_points(leaf);
    if (has_subset_sums) {
      add_subsets();
    } else {
      add_points();
    }
    if (map_.has_scans()) s_.scans.add_points_to_queries(crossing(), s_.points_of_crossing.data());
  }

  Relation relate_to_groups(std::size_t level, std::size_t node) const {
    const Boxes& boxes = map_.boxes_of(level);
    const std::array<float, 3> lo = {boxes.lo[0][node], boxes.lo[1][node], boxes.lo[2][node]};
    const std::array<float, 3> hi = {boxes.hi[0][node], boxes.hi[1][node], boxes.hi[2][node]};
    return relation_of<16>(lo, hi, pointers(s_.group_lo, 0), pointers(s_.group_hi, 0), num_groups_, s_.squared_radius);
  }

  /// The leaf against each query of some groups: lists the queries whose ball holds all of it or some of it.
  void relate_to_queries(std::size_t leaf, std::uint64_t groups) {
    std::array<float, 3> lo;
    std::array<float, 3> hi;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lo[axis] = map_.packed.leaf_boxes.lo[axis][leaf] - s_.center_from_origin[axis];
      hi[axis] = map_.packed.leaf_boxes.hi[axis][leaf] - s_.center_from_origin[axis];
    }
    BallScratch& s = s_;  // and counts in locals: vectors are stored as any type, and would have members read again
    const std::size_t num_queries = super_group_.num_queries;
    std::size_t num_inside = 0;
    std::size_t num_crossing = 0;
    const hn::CappedTag<float, kGroup> d;
    const hn::Rebind<std::uint32_t, decltype(d)> numbers;
    for (; groups != 0; groups &= groups - 1) {
      const auto first = kGroup * static_cast<std::size_t>(std::countr_zero(groups));
      const auto of_group = pointers(s.queries, first);
      relate(d, lo, hi, of_group, of_group, kGroup, s.squared_radius,
             [&](std::size_t i, auto inside, auto crossing) HWY_ATTR {
               const std::size_t rest = num_queries - std::min(num_queries, first + i);
               const auto exist = hn::FirstN(d, rest);  // the last group is filled up with copies of the last query
               const auto number = hn::Iota(numbers, static_cast<std::uint32_t>(first + i));
               num_inside += list(number, hn::RebindMask(numbers, hn::And(exist, inside)), &s.inside[num_inside]);
               num_crossing +=
                   list(number, hn::RebindMask(numbers, hn::And(exist, crossing)), &s.crossing[num_crossing]);
             });
    }
    s.num_inside = num_inside;
    s.num_crossing = num_crossing;
  }

  /// Writes the chosen numbers one after the other and returns how many there are. Overwrites a whole vector.
  template <class V, class Mask>
  static HWY_INLINE std::size_t list(V number, Mask chosen, std::uint32_t* numbers) {
    const hn::DFromV<V> d;
    hn::StoreU(hn::Compress(number, chosen), d, numbers);
    return hn::CountTrue(d, chosen);
  }

  std::span<const std::uint32_t> crossing() const { return {s_.crossing.data(), s_.num_crossing}; }

  /// The points of a leaf about the center, and the sums over each of them alone.
  void load_points(std::size_t leaf) {
    double from_center[3][kLeaf];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double* coordinates = map_.packed.leaf_axis(leaf, axis);
      const double center = s_.center[static_cast<Eigen::Index>(axis)];
      for (std::size_t i = 0; i < kLeaf; ++i) {
        from_center[axis][i] = coordinates[i] - center;
        s_.points[axis][i] = static_cast<float>(from_center[axis][i]);
      }
    }
    for (std::size_t i = 0; i < kLeaf; ++i) {
      const double x = from_center[0][i];
      const double y = from_center[1][i];
      const double z = from_center[2][i];
      double* alone = s_.subset_sums[i / 4][std::size_t{1} << (i % 4)].data();
      set_products(x, y, z, alone);
      alone[8] = z * z;
      alone[9] = 1;
    }
  }

  /// x y z xx xy xz yy yz = (x y z x x x y y) · (1 1 1 x y z y z)
  static HWY_INLINE void set_products(double x, double y, double z, double* products) {
    constexpr double kX = 1;
    constexpr double kY = 2;
    constexpr double kZ = 3;
    alignas(64) static constexpr double kFirst[8] = {kX, kY, kZ, kX, kX, kX, kY, kY};
    alignas(64) static constexpr double kSecond[8] = {0, 0, 0, kX, kY, kZ, kY, kZ};
    const hn::CappedTag<double, 8> d;
    const auto choose = [&](auto which, auto otherwise) HWY_ATTR {
      const auto with_x = hn::IfThenElse(hn::Eq(which, hn::Set(d, kX)), hn::Set(d, x), otherwise);
      const auto with_y = hn::IfThenElse(hn::Eq(which, hn::Set(d, kY)), hn::Set(d, y), with_x);
      return hn::IfThenElse(hn::Eq(which, hn::Set(d, kZ)), hn::Set(d, z), with_y);
    };
    const auto one = hn::Set(d, 1.0);
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
      const auto first = choose(hn::Load(d, kFirst + i), one);
      const auto second = choose(hn::Load(d, kSecond + i), one);
      hn::Store(hn::Mul(first, second), d, products + i);
    }
  }

  /// From the sums over one point each, entries 1 2 4 8 of every quarter, those over any of the four.
  void add_up_subsets() {
    for (auto& sums : s_.subset_sums) {
      for_vectors_of_row([&](auto d, std::size_t i) HWY_ATTR {
        const auto store = [&](auto sum, std::size_t subset) HWY_ATTR { hn::Store(sum, d, sums[subset].data() + i); };
        const auto p0 = hn::Load(d, sums[1].data() + i);
        const auto p1 = hn::Load(d, sums[2].data() + i);
        const auto p2 = hn::Load(d, sums[4].data() + i);
        const auto p3 = hn::Load(d, sums[8].data() + i);
        const auto p01 = hn::Add(p0, p1);
        const auto p23 = hn::Add(p2, p3);
        store(hn::Zero(d), 0);
        store(p01, 3);
        store(hn::Add(p0, p2), 5);
        store(hn::Add(p1, p2), 6);
        store(hn::Add(p01, p2), 7);
        store(hn::Add(p0, p3), 9);
        store(hn::Add(p1, p3), 10);
        store(hn::Add(p01, p3), 11);
        store(p23, 12);
        store(hn::Add(p0, p23), 13);
        store(hn::Add(p1, p23), 14);
        store(hn::Add(p01, p23), 15);
      });
    }
  }

  MomentRow sum_of_leaf(bool has_subset_sums, std::size_t num_points) const {
    MomentRow sum;
    const auto add = [&](std::size_t quarter, std::size_t subset) {
      for (std::size_t i = 0; i < MomentRow::kSize; ++i) sum.sums[i] += s_.subset_sums[quarter][subset][i];
    };
    if (has_subset_sums && num_points == kLeaf) {
      for (std::size_t quarter = 0; quarter < 4; ++quarter) add(quarter, 15);
    } else {
      for (std::size_t i = 0; i < num_points; ++i) add(i / 4, std::size_t{1} << (i % 4));
    }
    return sum;
  }

  void add_whole_leaf(const MomentRow& whole, std::uint64_t groups) {
    for (; groups != 0; groups &= groups - 1) {
      const auto group = static_cast<std::size_t>(std::countr_zero(groups));
      s_.sums_of_group[group].add(whole);
      if (map_.has_scans()) s_.scans.add_node_to_group(group);
    }
    for (const std::size_t query : std::span(s_.inside).first(s_.num_inside)) {
      add_row(whole.sums, s_.query_sums[query].data());
    }
    if (map_.has_scans()) s_.scans.add_leaf_to_queries(std::span(s_.inside).first(s_.num_inside));
  }

  /// Which points of the leaf at hand are in the ball around each crossing query: one bit each.
  void find_points(std::size_t leaf) {
    BallScratch& s = s_;
    const LeafVectors::D d;
    LeafVectors points;
    for (std::size_t v = 0; v < LeafVectors::kCount; ++v) {
      points.x[v] = hn::Load(d, s.points[0].data() + v * hn::Lanes(d));
      points.y[v] = hn::Load(d, s.points[1].data() + v * hn::Lanes(d));
      points.z[v] = hn::Load(d, s.points[2].data() + v * hn::Lanes(d));
    }
    const std::size_t num_crossing = s.num_crossing;
    for (std::size_t i = 0; i < num_crossing; ++i) {
      s.points_of_crossing[i] = static_cast<std::uint16_t>(points_within(points, leaf, s.crossing[i]));
    }
  }

  /// The same for one query. Lanes are points.
  HWY_INLINE std::uint32_t points_within(const LeafVectors& points, std::size_t leaf, std::size_t query) const {
    const LeafVectors::D d;
    const auto x = hn::Set(d, s_.queries[0][query]);
    const auto y = hn::Set(d, s_.queries[1][query]);
    const auto z = hn::Set(d, s_.queries[2][query]);
    const auto sure = hn::Set(d, s_.squared_radius.sure);
    const auto maybe = hn::Set(d, s_.squared_radius.maybe);
    std::uint32_t inside = 0;
    std::uint32_t near = 0;
    for (std::size_t v = 0; v < LeafVectors::kCount; ++v) {
      const auto dx = hn::Sub(points.x[v], x);
      const auto dy = hn::Sub(points.y[v], y);
      const auto dz = hn::Sub(points.z[v], z);
      const auto squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
      inside |= bits_of(d, hn::Lt(squared, sure)) << (v * hn::Lanes(d));
      near |= bits_of(d, hn::Lt(squared, maybe)) << (v * hn::Lanes(d));
    }
    if (HWY_UNLIKELY(inside != near)) inside |= decide(leaf, query, near & ~inside);
    return inside;
  }

  /// Those of the doubtful points that are within the radius.
  HWY_NOINLINE std::uint32_t decide(std::size_t leaf, std::size_t query, std::uint32_t doubtful) const {
    const Eigen::Vector3d at = queries_.point(super_group_.first_query + query);
    std::uint32_t inside = 0;
    for (std::uint32_t rest = doubtful; rest != 0; rest &= rest - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(rest));
      if (is_within(map_.packed.point(leaf * kLeaf + i), at, squared_radius_)) inside |= rest & (~rest + 1);
    }
    return inside;
  }

  /// Four lookups a query instead of up to sixteen additions.
  void add_subsets() {
    BallScratch& s = s_;
    const std::size_t num_crossing = s.num_crossing;
    for (std::size_t i = 0; i < num_crossing; ++i) {
      const std::uint32_t points = s.points_of_crossing[i];
      const double* first = s.subset_sums[0][points & 15U].data();
      const double* second = s.subset_sums[1][(points >> 4U) & 15U].data();
      const double* third = s.subset_sums[2][(points >> 8U) & 15U].data();
      const double* fourth = s.subset_sums[3][points >> 12U].data();
      double* sums = s.query_sums[s.crossing[i]].data();
      for_vectors_of_row([&](auto d, std::size_t k) HWY_ATTR {
        const auto half = hn::Add(hn::Load(d, first + k), hn::Load(d, second + k));
        const auto other_half = hn::Add(hn::Load(d, third + k), hn::Load(d, fourth + k));
        hn::Store(hn::Add(hn::Load(d, sums + k), hn::Add(half, other_half)), d, sums + k);
      });
    }
  }

  void add_points() {
    for (std::size_t i = 0; i < s_.num_crossing; ++i) {
      double* sums = s_.query_sums[s_.crossing[i]].data();
      for (std::uint32_t points = s_.points_of_crossing[i]; points != 0; points &= points - 1) {
        const auto point = static_cast<std::size_t>(std::countr_zero(points));
        add_row(s_.subset_sums[point / 4][std::size_t{1} << (point % 4)].data(), sums);
      }
    }
  }

  static HWY_INLINE void add_row(const double* row, double* sums) {
    for_vectors_of_row([&](auto d, std::size_t i)
                           HWY_ATTR { hn::Store(hn::Add(hn::Load(d, sums + i), hn::LoadU(d, row + i)), d, sums + i); });
  }

  void add_to_all(std::size_t level, std::size_t node) {
    s_.sums_of_all.add(moments_about_center(level, node));
    if (!map_.has_scans()) return;
    set_scans_of(level, node);
    s_.scans.add_node_to_all();
  }

  void add_to_groups(std::uint64_t groups, std::size_t node) {
    const MomentRow moments = moments_about_center(1, node);
    if (map_.has_scans()) set_scans_of(1, node);
    for (; groups != 0; groups &= groups - 1) {
      const auto group = static_cast<std::size_t>(std::countr_zero(groups));
      s_.sums_of_group[group].add(moments);
      if (map_.has_scans()) s_.scans.add_node_to_group(group);
    }
  }

  MomentRow moments_about_center(std::size_t level, std::size_t node) const {
    const Tree::Level& nodes = map_.levels[level - 1];
    return nodes.moments[node].shifted(map_.packed.origin + nodes.center(node) - s_.center);
  }

  void set_scans_of(std::size_t level, std::size_t node) {
    const std::size_t first = map_.first_point(level, node);
    s_.scans.set_node(std::span(map_.scans).subspan(first, map_.end_point(level, node) - first));
  }

  template <class Arrays>
  static std::array<const float*, 3> pointers(const Arrays& arrays, std::size_t offset) {
    return {arrays[0].data() + offset, arrays[1].data() + offset, arrays[2].data() + offset};
  }

  const Tree& map_;
  const PackedPoints& queries_;
  double squared_radius_;
  const SuperGroup& super_group_;
  std::size_t num_groups_;
  BallScratch& s_;
};

void add_balls(const Tree& map, const PackedPoints& queries, double radius_m, const SuperGroup& super_group,
               BallScratch& scratch) {
  Walk(map, queries, radius_m, super_group, scratch).run();
}

/// Some symmetric matrices, one a lane.
template <class V>
struct Matrices {
  V xx, xy, xz, yy, yz, zz;
};

/// Jacobi's rotation that makes `pq` zero; `pr` and `qr` are the other two off-diagonal elements.
template <class V>
HWY_INLINE void rotate(V& p, V& q, V& pq, V& pr, V& qr) {
  const hn::DFromV<V> d;
  const V difference = hn::Sub(q, p);
  const V twice = hn::Add(pq, pq);
  const V root = hn::Sqrt(hn::MulAdd(difference, difference, hn::Mul(twice, twice)));
  const V denominator = hn::Add(hn::Abs(difference), root);
  const V size = hn::Div(twice, hn::IfThenElse(hn::Eq(denominator, hn::Zero(d)), hn::Set(d, 1.0), denominator));
  const V tangent = hn::IfThenElse(hn::Lt(difference, hn::Zero(d)), hn::Neg(size), size);
  const V cosine = hn::Div(hn::Set(d, 1.0), hn::Sqrt(hn::MulAdd(tangent, tangent, hn::Set(d, 1.0))));
  const V sine = hn::Mul(tangent, cosine);
  p = hn::NegMulAdd(tangent, pq, p);
  q = hn::MulAdd(tangent, pq, q);
  pq = hn::Zero(d);
  const V old_pr = pr;
  pr = hn::Sub(hn::Mul(cosine, old_pr), hn::Mul(sine, qr));
  qr = hn::MulAdd(sine, old_pr, hn::Mul(cosine, qr));
}

/// What is left beside the diagonal moves an eigenvalue by its square over the gap to the next, or by itself.
template <class V>
HWY_INLINE bool is_diagonal(const Matrices<V>& m) {
  const hn::DFromV<V> d;
  const V off = hn::Max(hn::Max(hn::Abs(m.xy), hn::Abs(m.xz)), hn::Abs(m.yz));
  const V gap =
      hn::Min(hn::Min(hn::Abs(hn::Sub(m.xx, m.yy)), hn::Abs(hn::Sub(m.xx, m.zz))), hn::Abs(hn::Sub(m.yy, m.zz)));
  const V small = hn::Set(d, 0x1p-60);
  return hn::AllTrue(d, hn::Or(hn::Le(off, small), hn::Le(hn::Mul(off, off), hn::Mul(small, gap))));
}

/// Covariances at a time, each about 1e-16 λ₃ off: a closed form would lose λ₁. Two vectors at a time, because a
/// rotation mostly waits for its roots and divisions.
constexpr std::size_t kProblems = 16;
using Elements = std::array<std::array<double, kProblems>, 6>;  // xx xy xz yy yz zz

void find_eigenvalues(const Elements& covariances, std::array<std::array<double, kProblems>, 3>& ascending) {
  const hn::CappedTag<double, kProblems / 2> d;
  using V = hn::Vec<decltype(d)>;
  constexpr std::size_t kTogether = 2;
  for (std::size_t begin = 0; begin < kProblems; begin += kTogether * hn::Lanes(d)) {
    Matrices<V> matrices[kTogether];
    V traces[kTogether];
    for (std::size_t k = 0; k < kTogether; ++k) {
      const auto load = [&](std::size_t element)
                            HWY_ATTR { return hn::LoadU(d, covariances[element].data() + begin + k * hn::Lanes(d)); };
      Matrices<V>& m = matrices[k];
      m = {load(0), load(1), load(2), load(3), load(4), load(5)};
      traces[k] = hn::Add(hn::Add(m.xx, m.yy), m.zz);
      const V scale = hn::Div(hn::Set(d, 1.0), hn::Max(traces[k], hn::Set(d, 1e-300)));  // squares must not overflow
      for (V* element : {&m.xx, &m.xy, &m.xz, &m.yy, &m.yz, &m.zz}) *element = hn::Mul(*element, scale);
    }
    constexpr int kMostSweeps = 10;  // three or four are common
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      if (is_diagonal(matrices[0]) && is_diagonal(matrices[1])) break;
      for (Matrices<V>& m : matrices) rotate(m.xx, m.yy, m.xy, m.xz, m.yz);
      for (Matrices<V>& m : matrices) rotate(m.xx, m.zz, m.xz, m.xy, m.yz);
      for (Matrices<V>& m : matrices) rotate(m.yy, m.zz, m.yz, m.xy, m.xz);
    }
    for (std::size_t k = 0; k < kTogether; ++k) {
      const Matrices<V>& m = matrices[k];
      const V unscaled = hn::Max(traces[k], hn::Zero(d));
      const V low = hn::Min(m.xx, m.yy);
      const V high = hn::Max(m.xx, m.yy);
      const std::array<V, 3> sorted = {hn::Min(low, m.zz), hn::Max(low, hn::Min(high, m.zz)), hn::Max(high, m.zz)};
      for (std::size_t i = 0; i < 3; ++i) {
        double* to = ascending[i].data() + begin + k * hn::Lanes(d);
        hn::StoreU(hn::Mul(hn::Max(sorted[i], hn::Zero(d)), unscaled), d, to);
      }
    }
  }
}

void eigenvalues(std::span<const Moments> moments, std::span<Eigen::Vector3d> result) {
  Elements elements{};
  std::array<std::array<double, kProblems>, 3> ascending;
  for (std::size_t begin = 0; begin < moments.size(); begin += kProblems) {
    const std::size_t count = std::min(kProblems, moments.size() - begin);
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Matrix3d& c = moments[begin + i].covariance;
      elements[0][i] = c(0, 0);
      elements[1][i] = c(0, 1);
      elements[2][i] = c(0, 2);
      elements[3][i] = c(1, 1);
      elements[4][i] = c(1, 2);
      elements[5][i] = c(2, 2);
    }
    find_eigenvalues(elements, ascending);
    for (std::size_t i = 0; i < count; ++i) {
      result[begin + i] = {ascending[0][i], ascending[1][i], ascending[2][i]};
    }
  }
}

}  // namespace trysquare::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace trysquare {
namespace {

std::vector<VectorKernels> find_kernels() {
  const std::int64_t supported = hwy::SupportedTargets();
  std::vector<VectorKernels> kernels;
  const auto offer = [&](std::int64_t target, auto add_balls, auto eigenvalues) {
    if ((supported & target) != 0) kernels.push_back({hwy::TargetName(target), add_balls, eigenvalues});
  };
#if HWY_TARGETS & HWY_AVX3
  offer(HWY_AVX3, N_AVX3::add_balls, N_AVX3::eigenvalues);
#endif
#if HWY_TARGETS & HWY_AVX2
  offer(HWY_AVX2, N_AVX2::add_balls, N_AVX2::eigenvalues);
#endif
#if HWY_TARGETS & HWY_SSE4
  offer(HWY_SSE4, N_SSE4::add_balls, N_SSE4::eigenvalues);
#endif
#if HWY_TARGETS & HWY_NEON
  offer(HWY_NEON, N_NEON::add_balls, N_NEON::eigenvalues);
#endif
  const char* at_least = hwy::TargetName(HWY_STATIC_TARGET);
  if (kernels.empty() || std::strcmp(kernels.back().name, at_least) != 0) {
    kernels.push_back({at_least, HWY_STATIC_DISPATCH(add_balls), HWY_STATIC_DISPATCH(eigenvalues)});
  }
  return kernels;
}

}  // namespace

const std::vector<VectorKernels>& vector_kernels() {
  static const std::vector<VectorKernels> kKernels = find_kernels();
  return kKernels;
}

}  // namespace trysquare
#endif
