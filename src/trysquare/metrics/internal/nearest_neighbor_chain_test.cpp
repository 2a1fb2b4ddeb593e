// SPDX-License-Identifier: Apache-2.0
#include "trysquare/metrics/internal/nearest_neighbor_chain.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace trysquare::internal {
namespace {

using Distances = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// A linkage by table: every merge has a list of distances that are new. Pairs that are in none are 20 apart.
class ScriptedLinkage {
 public:
  ScriptedLinkage(std::size_t size, Distances distances, std::map<std::vector<std::uint32_t>, Distances> after_merge)
      : size_(size), distances_(std::move(distances)), after_merge_(std::move(after_merge)) {}

  std::size_t size() const { return size_; }
  ClusterPlace place(std::uint32_t /*cluster*/) const { return {Eigen::Vector3d::Zero(), 1}; }
  double lower_bound(std::uint32_t /*cluster*/, const ClusterRegion& /*region*/) const { return 0; }
  double squared_distance(std::uint32_t a, std::uint32_t b, double /*stop_above*/) const {
    const auto found = distances_.find(std::minmax(a, b));
    return found == distances_.end() ? 20 : found->second;
  }
  void merge(std::uint32_t kept, std::uint32_t gone) {
    for (const auto& [pair, distance] : after_merge_[{kept, gone}]) distances_[pair] = distance;
  }

 private:
  std::size_t size_;
  Distances distances_;
  std::map<std::vector<std::uint32_t>, Distances> after_merge_;
};

using Clusters = std::vector<std::uint32_t>;

TEST(NearestNeighborChain, MergesEachOthersNearestAndLeavesWhatIsAtTheLimit) {
  const Distances distances = {{{0, 1}, 10}, {{1, 2}, 5}, {{2, 3}, 4}};
  const std::map<std::vector<std::uint32_t>, Distances> after_merge = {{{2, 3}, {{{1, 2}, 15}}}};
  EXPECT_EQ(NearestNeighborChain(ScriptedLinkage(4, distances, after_merge), 15.0).run(), (Clusters{0, 0, 2, 2}));
  EXPECT_EQ(NearestNeighborChain(ScriptedLinkage(4, distances, after_merge), 10.0).run(), (Clusters{0, 1, 2, 2}));
}

TEST(NearestNeighborChain, TakesTheLowestOfPairsAtTheSameDistance) {
  const Distances distances = {{{0, 1}, 5}, {{1, 2}, 5}};
  const std::map<std::vector<std::uint32_t>, Distances> after_merge = {{{0, 1}, {{{1, 2}, 20}}},
                                                                       {{1, 2}, {{{0, 1}, 20}}}};
  EXPECT_EQ(NearestNeighborChain(ScriptedLinkage(3, distances, after_merge), 6.0).run(), (Clusters{0, 0, 2}));
}

// When 3 and 4 merge, they come nearer to 1, which has 2 for its nearest: no exact linkage does that, rounding may. The
// chain 0, 1, 2, 3 then meets 1 again. After 1 and 3 merge, 2 is out of reach, whatever it was when the chain passed
// it.
TEST(NearestNeighborChain, ForgetsItsEndWhenItMeetsItself) {
  const Distances distances = {{{0, 1}, 10}, {{1, 2}, 5}, {{2, 3}, 4}, {{3, 4}, 3}};
  const std::map<std::vector<std::uint32_t>, Distances> after_merge = {{{3, 4}, {{{1, 3}, 3.5}, {{2, 3}, 4.5}}},
                                                                       {{1, 3}, {{{0, 1}, 8}, {{1, 2}, 16}}}};
  EXPECT_EQ(NearestNeighborChain(ScriptedLinkage(5, distances, after_merge), 15.0).run(), (Clusters{0, 0, 2, 0, 0}));
}

}  // namespace
}  // namespace trysquare::internal
