// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/all_pairs_rpe.h"

#include "trysquare/core/error.h"
#include "trysquare/parallel/for_each_block.h"
#include "trysquare/trajectory/internal/validate.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace trysquare {
namespace {

/// For doubles >= 0 the order of the bits is the order of the values. Bins of equal leading bits: sign, 11 of exponent,
/// 4 of mantissa, so that a bin is 3 to 6 % of its value wide.
constexpr int kBinBits = 16;

std::size_t bin_of(double error) { return std::bit_cast<std::uint64_t>(error) >> (64 - kBinBits); }

/// What a part of the errors adds to the first pass, which counts the values in bins.
class FirstPass {
 public:
  void add(double error) {
    ++count_;
    sum_ += error;
    sse_ += error * error;
    min_ = std::min(min_, error);
    max_ = std::max(max_, error);
    ++bins_[bin_of(error)];
  }

  void add(const FirstPass& other) {
    count_ += other.count_;
    sum_ += other.sum_;
    sse_ += other.sse_;
    min_ = std::min(min_, other.min_);
    max_ = std::max(max_, other.max_);
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) bins_[bin] += other.bins_[bin];
  }

  /// Without median and std, which the second pass finds.
  ErrorStatistics statistics() const {
    const double n = static_cast<double>(count_);
    return {.count = count_, .rmse = std::sqrt(sse_ / n), .mean = sum_ / n, .min = min_, .max = max_, .sse = sse_};
  }

  std::size_t bin_of_rank(std::size_t rank) const {
    std::size_t num_up_to = 0;
    for (std::size_t bin = 0;; ++bin) {
      num_up_to += bins_[bin];
      if (rank < num_up_to) return bin;
    }
  }

 private:
  std::size_t count_ = 0;
  double sum_ = 0;
  double sse_ = 0;
  double min_ = std::numeric_limits<double>::infinity();
  double max_ = 0;
  std::vector<std::uint64_t> bins_ = std::vector<std::uint64_t>(std::size_t{1} << kBinBits);
};

/// The second pass keeps only the bins that hold the middle of the list.
class SecondPass {
 public:
  explicit SecondPass(const FirstPass& first)
      : result_(first.statistics()),
        lower_bin_(first.bin_of_rank((result_.count - 1) / 2)),
        upper_bin_(first.bin_of_rank(result_.count / 2)) {}

  void add(double error) {
    squared_deviations_ += (error - result_.mean) * (error - result_.mean);
    const std::size_t bin = bin_of(error);
    num_below_ += static_cast<std::size_t>(bin < lower_bin_);
    if (bin == lower_bin_ || bin == upper_bin_) middle_.push_back(error);
  }

  void add(const SecondPass& other) {
    squared_deviations_ += other.squared_deviations_;
    num_below_ += other.num_below_;
    middle_.insert(middle_.end(), other.middle_.begin(), other.middle_.end());
  }

  ErrorStatistics statistics() {
    result_.std = std::sqrt(squared_deviations_ / static_cast<double>(result_.count));
    const double lower = middle_value((result_.count - 1) / 2);
    const double upper = middle_value(result_.count / 2);
    result_.median = lower == upper ? lower : (lower + upper) / 2;
    return result_;
  }

 private:
  double middle_value(std::size_t rank) {
    const auto at = middle_.begin() + static_cast<std::ptrdiff_t>(rank - num_below_);
    std::nth_element(middle_.begin(), at, middle_.end());
    return *at;
  }

  ErrorStatistics result_;
  std::size_t lower_bin_;
  std::size_t upper_bin_;
  double squared_deviations_ = 0;
  std::size_t num_below_ = 0;   ///< Values in bins below lower_bin_.
  std::vector<double> middle_;  ///< Values of the bins that hold the middle.
};

/// One pass over the translations and one over the rotations.
template <class Pass>
struct Passes {
  Pass translation;
  Pass rotation;

  void add(const Passes& other) {
    translation.add(other.translation);
    rotation.add(other.rotation);
  }
};

/// Calls visit(translation_m, rotation_rad) for one i and all j > i. E_ij is multiplied out so that a pair costs four
/// 3×3 products: with R, r the reference and S, s the estimate, its rotation is R_jᵀ (R_i S_iᵀ) S_j and its translation
/// R_jᵀ (R_i S_iᵀ (s_j − s_i) − R_i R_iᵀ (r_j − r_i)).
template <class Visit>
void for_each_second_pose(const Trajectory& reference, const Trajectory& estimate, std::size_t i, Visit visit) {
  const Pose& ref_i = reference.world_from_scan[i];
  const Pose& est_i = estimate.world_from_scan[i];
  const Eigen::Matrix3d ref_i_est_i = ref_i.rotation * est_i.rotation.transpose();
  const Eigen::Matrix3d ref_i_ref_i = ref_i.rotation * ref_i.rotation.transpose();
  for (std::size_t j = i + 1; j < reference.size(); ++j) {
    const Pose& ref_j = reference.world_from_scan[j];
    const Pose& est_j = estimate.world_from_scan[j];
    const Eigen::Vector3d difference =
        ref_i_est_i * (est_j.translation - est_i.translation) - ref_i_ref_i * (ref_j.translation - ref_i.translation);
    const Eigen::Matrix3d rotation = ref_j.rotation.transpose() * (ref_i_est_i * est_j.rotation);
    visit((ref_j.rotation.transpose() * difference).norm(), rotation_angle(rotation));
  }
}

/// A pass over all pairs, on several threads: item k are the pairs of the first poses k and n − 1 − k, so that items
/// are of equal size. At most 32 blocks, whose parts are added in their order.
template <class Pass>
Passes<Pass> run_pass(const Trajectory& reference, const Trajectory& estimate, const Passes<Pass>& start,
                      const Execution& execution) {
  constexpr std::size_t kMaxBlocks = 32;
  constexpr std::size_t kSmallestBlock = 32;  // bins cost more than the pairs of fewer
  const std::size_t num_firsts = reference.size() - 1;
  const std::size_t num_items = (num_firsts + 1) / 2;
  const std::size_t block_size = std::max((num_items + kMaxBlocks - 1) / kMaxBlocks, kSmallestBlock);
  std::vector<Passes<Pass>> parts(num_blocks(num_items, block_size), start);
  for_each_block(num_items, block_size, execution, "pairs of poses", [&](const Block& block) {
    Passes<Pass>& part = parts[block.index];
    const auto visit = [&](double translation_m, double rotation_rad) {
      part.translation.add(translation_m);
      part.rotation.add(rotation_rad);
    };
    for (std::size_t item = block.begin; item < block.end; ++item) {
      const std::size_t mirrored = num_firsts - 1 - item;
      for_each_second_pose(reference, estimate, item, visit);
      if (mirrored != item) for_each_second_pose(reference, estimate, mirrored, visit);
    }
  });
  for (std::size_t i = 1; i < parts.size(); ++i) parts[0].add(parts[i]);
  return std::move(parts[0]);
}

}  // namespace

AllPairsRpe all_pairs_rpe(const Trajectory& reference, const Trajectory& estimate, const Execution& execution) {
  internal::validate_poses(reference, estimate);
  if (reference.size() < 2) throw InvalidArgument("relative pose errors need at least two poses, there is one");
  const Passes<FirstPass> first = run_pass<FirstPass>(reference, estimate, {}, execution);
  Passes<SecondPass> second =
      run_pass<SecondPass>(reference, estimate, {SecondPass(first.translation), SecondPass(first.rotation)}, execution);
  return {.translation_m = second.translation.statistics(), .rotation_rad = second.rotation.statistics()};
}

}  // namespace trysquare
