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
      const auto span = hn::Max(hn::Sub(h, hn::Set(d, lo[axis])), hn::Sub(hn::Set(d, hi[axis]), l));
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
    s_.num_inside = 0;
    s_.num_crossing = 0;
    const hn::CappedTag<float, kGroup> d;
    const hn::Rebind<std::uint32_t, decltype(d)> numbers;
    for (; groups != 0; groups &= groups - 1) {
      const auto first = kGroup * static_cast<std::size_t>(std::countr_zero(groups));
      const auto of_group = pointers(s_.queries, first);
      relate(d, lo, hi, of_group, of_group, kGroup, s_.squared_radius,
             [&](std::size_t i, auto inside, auto crossing) HWY_ATTR {
               const std::size_t rest = super_group_.num_queries - std::min(super_group_.num_queries, first + i);
               const auto exist = hn::FirstN(d, rest);  // the last group is filled up with copies of the last query
               const auto number = hn::Iota(numbers, static_cast<std::uint32_t>(first + i));
               s_.num_inside +=
                   list(number, hn::RebindMask(numbers, hn::And(exist, inside)), &s_.inside[s_.num_inside]);
               s_.num_crossing +=
                   list(number, hn::RebindMask(numbers, hn::And(exist, crossing)), &s_.crossing[s_.num_crossing]);
             });
    }
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
      set_products(x, y, z, s_.subset_sums[i / 4][std::size_t{1} << (i % 4)].data());
      s_.subset_tails[i / 4][std::size_t{1} << (i % 4)] = {z * z, 1};
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

  void add_up_subsets() {
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      add_up_quarter(hn::CappedTag<double, 8>(), 8, s_.subset_sums[quarter]);
      add_up_quarter(hn::CappedTag<double, 2>(), 2, s_.subset_tails[quarter]);
    }
  }

  /// From the sums over one point each, entries 1 2 4 8, those over any of the four.
  template <class D, class Sums>
  static HWY_INLINE void add_up_quarter(D d, std::size_t size, Sums& sums) {
    for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
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
    }
  }

  MomentRow sum_of_leaf(bool has_subset_sums, std::size_t num_points) const {
    MomentRow sum;
    const auto add = [&](std::size_t quarter, std::size_t subset) {
      for (std::size_t i = 0; i < 8; ++i) sum.sums[i] += s_.subset_sums[quarter][subset][i];
      for (std::size_t i = 0; i < 2; ++i) sum.sums[8 + i] += s_.subset_tails[quarter][subset][i];
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
      set_sum(s_.query_sums[query].data(), whole.sums, s_.query_sums[query].data());
      set_tail_sum(s_.query_tails[query].data(), whole.sums + 8, s_.query_tails[query].data());
    }
    if (map_.has_scans()) s_.scans.add_leaf_to_queries(std::span(s_.inside).first(s_.num_inside));
  }

  /// Which points of the leaf at hand are in the ball around each crossing query: one bit each. Lanes are points.
  void find_points(std::size_t leaf) {
    const hn::CappedTag<float, kLeaf> d;
    constexpr std::size_t kVectors = kLeaf / hn::MaxLanes(d);
    hn::Vec<decltype(d)> x[kVectors];
    hn::Vec<decltype(d)> y[kVectors];
    hn::Vec<decltype(d)> z[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) {
      x[v] = hn::Load(d, s_.points[0].data() + v * hn::Lanes(d));
      y[v] = hn::Load(d, s_.points[1].data() + v * hn::Lanes(d));
      z[v] = hn::Load(d, s_.points[2].data() + v * hn::Lanes(d));
    }
    const auto sure = hn::Set(d, s_.squared_radius.sure);
    const auto maybe = hn::Set(d, s_.squared_radius.maybe);
    for (std::size_t i = 0; i < s_.num_crossing; ++i) {
      const std::size_t query = s_.crossing[i];
      const auto query_x = hn::Set(d, s_.queries[0][query]);
      const auto query_y = hn::Set(d, s_.queries[1][query]);
      const auto query_z = hn::Set(d, s_.queries[2][query]);
      std::uint32_t inside = 0;
      std::uint32_t near = 0;
      for (std::size_t v = 0; v < kVectors; ++v) {
        const auto dx = hn::Sub(x[v], query_x);
        const auto dy = hn::Sub(y[v], query_y);
        const auto dz = hn::Sub(z[v], query_z);
        const auto squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        inside |= bits_of(d, hn::Lt(squared, sure)) << (v * hn::Lanes(d));
        near |= bits_of(d, hn::Lt(squared, maybe)) << (v * hn::Lanes(d));
      }
      if (HWY_UNLIKELY(inside != near)) inside |= decide(leaf, query, near & ~inside);
      s_.points_of_crossing[i] = static_cast<std::uint16_t>(inside);
    }
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
    const auto add = [](auto d, std::size_t size, const std::size_t* m, const auto& subsets, double* sums) HWY_ATTR {
      for (std::size_t i = 0; i < size; i += hn::Lanes(d)) {
        const auto first = hn::Add(hn::Load(d, subsets[0][m[0]].data() + i), hn::Load(d, subsets[1][m[1]].data() + i));
        const auto second = hn::Add(hn::Load(d, subsets[2][m[2]].data() + i), hn::Load(d, subsets[3][m[3]].data() + i));
        hn::Store(hn::Add(hn::Load(d, sums + i), hn::Add(first, second)), d, sums + i);
      }
    };
    for (std::size_t i = 0; i < s_.num_crossing; ++i) {
      const std::size_t query = s_.crossing[i];
      const std::uint32_t points = s_.points_of_crossing[i];
      const std::size_t m[4] = {points & 15U, (points >> 4U) & 15U, (points >> 8U) & 15U, points >> 12U};
      add(hn::CappedTag<double, 8>(), 8, m, s_.subset_sums, s_.query_sums[query].data());
      add(hn::CappedTag<double, 2>(), 2, m, s_.subset_tails, s_.query_tails[query].data());
    }
  }

  void add_points() {
    for (std::size_t i = 0; i < s_.num_crossing; ++i) {
      double* sums = s_.query_sums[s_.crossing[i]].data();
      double* tail = s_.query_tails[s_.crossing[i]].data();
      for (std::uint32_t points = s_.points_of_crossing[i]; points != 0; points &= points - 1) {
        const auto point = static_cast<std::size_t>(std::countr_zero(points));
        const std::size_t alone = std::size_t{1} << (point % 4);
        set_sum(sums, s_.subset_sums[point / 4][alone].data(), sums);
        set_tail_sum(tail, s_.subset_tails[point / 4][alone].data(), tail);
      }
    }
  }

  static HWY_INLINE void set_sum(const double* a, const double* b, double* sum) {
    const hn::CappedTag<double, 8> d;
    for (std::size_t i = 0; i < 8; i += hn::Lanes(d)) {
      hn::StoreU(hn::Add(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, sum + i);
    }
  }
  static HWY_INLINE void set_tail_sum(const double* a, const double* b, double* sum) {
    const hn::CappedTag<double, 2> d;
    for (std::size_t i = 0; i < 2; i += hn::Lanes(d)) {
      hn::StoreU(hn::Add(hn::LoadU(d, a + i), hn::LoadU(d, b + i)), d, sum + i);
    }
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

/// Eight covariances at a time, each about 1e-16 λ₃ off: a closed form would lose λ₁.
constexpr std::size_t kProblems = 8;
using Elements = std::array<std::array<double, kProblems>, 6>;  // xx xy xz yy yz zz

void find_eigenvalues(const Elements& covariances, std::array<std::array<double, kProblems>, 3>& ascending) {
  const hn::CappedTag<double, kProblems> d;
  using V = hn::Vec<decltype(d)>;
  for (std::size_t i = 0; i < kProblems; i += hn::Lanes(d)) {
    V xx = hn::LoadU(d, covariances[0].data() + i);
    V xy = hn::LoadU(d, covariances[1].data() + i);
    V xz = hn::LoadU(d, covariances[2].data() + i);
    V yy = hn::LoadU(d, covariances[3].data() + i);
    V yz = hn::LoadU(d, covariances[4].data() + i);
    V zz = hn::LoadU(d, covariances[5].data() + i);
    const V trace = hn::Add(hn::Add(xx, yy), zz);
    const V scale = hn::Div(hn::Set(d, 1.0), hn::Max(trace, hn::Set(d, 1e-300)));  // squares must not overflow
    for (V* element : {&xx, &xy, &xz, &yy, &yz, &zz}) *element = hn::Mul(*element, scale);
    constexpr int kMostSweeps = 10;  // four are common
    for (int sweep = 0; sweep < kMostSweeps; ++sweep) {
      const V off = hn::Max(hn::Max(hn::Abs(xy), hn::Abs(xz)), hn::Abs(yz));
      if (hn::AllTrue(d, hn::Le(off, hn::Set(d, 0x1p-60)))) break;
      rotate(xx, yy, xy, xz, yz);
      rotate(xx, zz, xz, xy, yz);
      rotate(yy, zz, yz, xy, xz);
    }
    const V unscaled = hn::Max(trace, hn::Zero(d));
    const V low = hn::Min(xx, yy);
    const V high = hn::Max(xx, yy);
    const V middle = hn::Max(low, hn::Min(high, zz));
    const std::array<V, 3> sorted = {hn::Min(low, zz), middle, hn::Max(high, zz)};
    for (std::size_t k = 0; k < 3; ++k) {
      hn::StoreU(hn::Mul(hn::Max(sorted[k], hn::Zero(d)), unscaled), d, ascending[k].data() + i);
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
