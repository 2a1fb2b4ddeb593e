// SPDX-License-Identifier: Apache-2.0
#include "trysquare/parallel/for_each_block.h"

#include "trysquare/core/error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

namespace trysquare {
namespace {

class ForEachBlock : public testing::TestWithParam<int> {};

TEST_P(ForEachBlock, VisitsEveryItemOnce) {
  std::vector<std::atomic<int>> visits(1003);
  for_each_block(visits.size(), 10, {.num_threads = GetParam()}, "test", [&](const Block& block) {
    EXPECT_EQ(block.begin, block.index * 10);
    for (std::size_t i = block.begin; i < block.end; ++i) ++visits[i];
  });
  for (const std::atomic<int>& visit : visits) EXPECT_EQ(visit, 1);
}

TEST_P(ForEachBlock, GivesBitIdenticalSumsForEveryNumberOfThreads) {
  const auto sum = [](int num_threads) {
    std::vector<double> partial(num_blocks(100'000, 1000));
    for_each_block(100'000, 1000, {.num_threads = num_threads}, "test", [&](const Block& block) {
      for (std::size_t i = block.begin; i < block.end; ++i) partial[block.index] += std::sin(static_cast<double>(i));
    });
    return std::accumulate(partial.begin(), partial.end(), 0.0);
  };
  EXPECT_EQ(sum(GetParam()), sum(1));
}

TEST_P(ForEachBlock, PassesOnWhatTheBodyThrows) {
  EXPECT_THROW(for_each_block(100, 1, {.num_threads = GetParam()}, "test",
                              [](const Block& block) {
                                if (block.index == 37) throw std::runtime_error("body");
                              }),
               std::runtime_error);
}

TEST_P(ForEachBlock, PassesOnTheErrorOfTheFirstBlockThatFails) {
  for (int repeat = 0; repeat < 20; ++repeat) {
    try {
      for_each_block(100, 1, {.num_threads = GetParam()}, "test", [](const Block& block) {
        if (block.index >= 3) throw std::runtime_error(std::to_string(block.index));
      });
      FAIL();
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "3");
    }
  }
}

TEST_P(ForEachBlock, ReportsProgressUpToTheTotal) {
  std::size_t last = 0;
  const Execution execution{.num_threads = GetParam(),
                            .progress = [&](std::string_view stage, std::size_t done, std::size_t total) {
                              EXPECT_EQ(stage, "counting");
                              EXPECT_EQ(total, 95u);
                              EXPECT_GE(done, last);
                              last = done;
                            }};
  for_each_block(95, 10, execution, "counting", [](const Block&) {});
  EXPECT_EQ(last, 95u);
}

INSTANTIATE_TEST_SUITE_P(Threads, ForEachBlock, testing::Values(0, 1, 2, 3));

TEST(ForEachBlockArguments, RefuseNegativeThreads) {
  EXPECT_THROW(for_each_block(1, 1, {.num_threads = -1}, "test", [](const Block&) {}), InvalidArgument);
}

TEST(ForEachBlockArguments, RefuseMoreThreadsThanTbbSurvives) {
  EXPECT_THROW(for_each_block(1, 1, {.num_threads = 100'000}, "test", [](const Block&) {}), InvalidArgument);
}

}  // namespace
}  // namespace trysquare
