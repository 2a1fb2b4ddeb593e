// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/stats/interval.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace trysquare {

/// What paired differences say about their mean.
struct PairedTest {
  std::size_t num_blocks = 0;
  double mean = 0;                   ///< Of the differences.
  double p_value = 1;                ///< Two-sided, of "the two are alike"; never below 2^(1 − num_blocks).
  std::optional<Interval> interval;  ///< Of the mean; empty: too few blocks to exclude anything at this confidence.
};

/// Exact sign-flip test of paired differences: were the two alike, every difference could as well have the other sign.
/// All combinations of signs are counted, no random numbers. Neighbors in a sequence are alike, so up to 16 blocks of
/// consecutive differences flip as one. The interval holds the means that the test does not exclude.
///
/// @param differences  a − b of n >= 1 pairs in their order in the sequence, all finite.
/// @param confidence   Of the interval, in (0, 1).
/// @throws InvalidArgument  if there are none, one is not finite, or `confidence` is out of range.
///
/// Source: Fisher, The Design of Experiments, 1935, §21; Lehmann & Romano, Testing Statistical Hypotheses, 2005, §5.8.
PairedTest paired_test(std::span<const double> differences, double confidence = 0.95);

/// The least p-value that paired_test() gives for so many differences, >= 1: when all of them have one sign.
double least_p_value(std::size_t num_differences);

/// Holm's correction: p-values of a family of tests, so that the chance of one false alarm in the family stays what a
/// single test promises. Same order; at most 1.
///
/// Source: Holm, A Simple Sequentially Rejective Multiple Test Procedure, 1979.
std::vector<double> holm_adjusted(std::span<const double> p_values);

}  // namespace trysquare
