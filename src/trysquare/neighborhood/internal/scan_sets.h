// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace trysquare {

/// Which scans each neighborhood of a super-group holds, exactly, for any number of scans. Scans get small numbers in
/// the order in which the super-group meets them, 64 to a word: one word is nearly always enough. What all queries, or
/// all queries of a group, have in common is kept once.
class ScanSets {
 public:
  static constexpr std::size_t kMaxQueries = 1024;
  static constexpr std::size_t kGroupSize = 16;

  explicit ScanSets(std::size_t num_scans) : number_of_scan_(num_scans, kNoNumber) {}

  /// Forgets everything.
  void start(std::size_t num_queries) {
    for (const std::uint32_t scan : numbered_) number_of_scan_[scan] = kNoNumber;
    numbered_.clear();
    num_words_ = 0;
    num_queries_ = num_queries;
  }

  /// The points of a node that one or more of the next calls are about. Scans that all queries have are no news.
  void set_node(std::span<const std::uint32_t> scans) {
    node_words_.assign(num_words_, 0);
    for (const std::uint32_t scan : scans) {
      const std::uint32_t number = number_of(scan);
      node_words_[number / 64] |= std::uint64_t{1} << (number % 64);
    }
    for (std::size_t w = 0; w < num_words_; ++w) node_words_[w] &= ~words_[w].all;
  }
  void add_node_to_all() {
    for (std::size_t w = 0; w < node_words_.size(); ++w) words_[w].all |= node_words_[w];
  }
  void add_node_to_group(std::size_t group) {
    for (std::size_t w = 0; w < node_words_.size(); ++w) words_[w].of_group[group] |= node_words_[w];
  }

  /// The points of a leaf: at most 16.
  void set_leaf(std::span<const std::uint32_t> scans) {
    set_node(scans);
    for (std::size_t i = 0; i < scans.size(); ++i) leaf_numbers_[i] = number_of_scan_[scans[i]];
  }
  void add_leaf_to_queries(std::span<const std::uint32_t> queries) {
    for (std::size_t w = 0; w < num_words_; ++w) {
      if (node_words_[w] == 0) continue;
      for (const std::uint32_t query : queries) words_[w].of_query[query] |= node_words_[w];
    }
  }
  /// Those points of the leaf whose bits are set: `points[i]` belongs to `queries[i]`. Looked up in a table of the
  /// scans of every subset of four points, without a branch: whether a scan is new cannot be predicted.
  void add_points_to_queries(std::span<const std::uint32_t> queries, const std::uint16_t* points) {
    for (std::size_t w = 0; w < num_words_; ++w) {
      if (node_words_[w] == 0) continue;
      const std::array<SubsetScans, 4> subsets = subsets_of_leaf(w);
      std::uint64_t* of_query = words_[w].of_query.data();
      for (std::size_t i = 0; i < queries.size(); ++i) {
        const std::uint32_t p = points[i];
        of_query[queries[i]] |=
            (subsets[0][p & 15U] | subsets[1][(p >> 4U) & 15U]) | (subsets[2][(p >> 8U) & 15U] | subsets[3][p >> 12U]);
      }
    }
  }

  std::uint32_t count(std::size_t query) const {
    int sum = 0;
    for (std::size_t w = 0; w < num_words_; ++w) {
      const Word& word = words_[w];
      sum += std::popcount(word.all | word.of_group[query / kGroupSize] | word.of_query[query]);
    }
    return static_cast<std::uint32_t>(sum);
  }

 private:
  static constexpr std::uint32_t kNoNumber = std::numeric_limits<std::uint32_t>::max();

  struct Word {
    std::uint64_t all;
    std::array<std::uint64_t, kMaxQueries / kGroupSize> of_group;
    std::array<std::uint64_t, kMaxQueries> of_query;
  };

  /// Entry m: the scans of those of four points whose bits are set in m.
  using SubsetScans = std::array<std::uint64_t, 16>;

  std::array<SubsetScans, 4> subsets_of_leaf(std::size_t word) const {
    std::array<SubsetScans, 4> subsets;
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      SubsetScans& of_quarter = subsets[quarter];
      of_quarter[0] = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t number = leaf_numbers_[4 * quarter + i];
        const std::uint64_t scan = number / 64 == word ? std::uint64_t{1} << (number % 64) : 0;
        for (std::size_t m = 0; m < std::size_t{1} << i; ++m)
          of_quarter[m | std::size_t{1} << i] = of_quarter[m] | scan;
      }
    }
    return subsets;
  }

  std::uint32_t number_of(std::uint32_t scan) {
    std::uint32_t& number = number_of_scan_[scan];
    if (number == kNoNumber) {
      number = static_cast<std::uint32_t>(numbered_.size());
      numbered_.push_back(scan);
      if (number / 64 == num_words_) add_word();
    }
    return number;
  }
  void add_word() {
    if (words_.size() == num_words_) words_.emplace_back();
    Word& word = words_[num_words_++];
    word.all = 0;
    word.of_group.fill(0);
    std::fill_n(word.of_query.begin(), num_queries_, 0);
    node_words_.resize(num_words_, 0);
  }

  std::vector<std::uint32_t> number_of_scan_;
  std::vector<std::uint32_t> numbered_;  ///< Scans that have a number now.
  std::vector<Word> words_;
  std::vector<std::uint64_t> node_words_;
  std::array<std::uint32_t, kGroupSize> leaf_numbers_{};
  std::size_t num_words_ = 0;
  std::size_t num_queries_ = 0;
};

}  // namespace trysquare
