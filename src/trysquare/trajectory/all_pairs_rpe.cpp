// SPDX-License-Identifier: Apache-2.0
#include "trysquare/trajectory/all_pairs_rpe.h"

#include "trysquare/core/error.h"
#include "trysquare/trajectory/internal/validate.h"
#include "trysquare/trajectory/rotation_angle.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace trysquare {
namespace {

/// error_statistics() of a list that is produced twice instead of being stored. The first pass counts the values in
/// bins of equal leading bits (for doubles >= 0 the order of the bits is the order of the values); the second keeps
/// only the bins that hold the middle of the list.
class StreamedStatistics {
 public:
  void first_pass(double error) {
    ++result_.count;
    sum_ += error;
    result_.sse += error * error;
    result_.min = result_.count == 1 ? error : std::min(result_.min, error);
    result_.max = std::max(result_.max, error);
    ++bins_[bin_of(error)];
  }

  void end_first_pass() {
    const double n = static_cast<double>(result_.count);
    result_.mean = sum_ / n;
    result_.rmse = std::sqrt(result_.sse / n);
    lower_bin_ = bin_of_rank((result_.count - 1) / 2);
    upper_bin_ = bin_of_rank(result_.count / 2);
  }

  void second_pass(double error) {
    squared_deviations_ += (error - result_.mean) * (error - result_.mean);
    const std::size_t bin = bin_of(error);
    num_below_ += static_cast<std::size_t>(bin < lower_bin_);
    if (bin == lower_bin_ || bin == upper_bin_) middle_.push_back(error);
  }

  ErrorStatistics result() {
    result_.std = std::sqrt(squared_deviations_ / static_cast<double>(result_.count));
    const double lower = middle_value((result_.count - 1) / 2);
    const double upper = middle_value(result_.count / 2);
    result_.median = lower == upper ? lower : (lower + upper) / 2;
    return result_;
  }

 private:
  static constexpr int kBinBits = 16;  ///< Sign, 11 of exponent, 4 of mantissa: a bin is 3 to 6 % of its value wide.

  static std::size_t bin_of(double error) { return std::bit_cast<std::uint64_t>(error) >> (64 - kBinBits); }

  std::size_t bin_of_rank(std::size_t rank) const {
    std::size_t num_up_to = 0;
    for (std::size_t bin = 0;; ++bin) {
      num_up_to += bins_[bin];
      if (rank < num_up_to) return bin;
    }
  }

  double middle_value(std::size_t rank) {
    const auto at = middle_.begin() + static_cast<std::ptrdiff_t>(rank - num_below_);
    std::nth_element(middle_.begin(), at, middle_.end());
    return *at;
  }

  ErrorStatistics result_;
  double sum_ = 0;
  double squared_deviations_ = 0;
  std::vector<std::uint64_t> bins_ = std::vector<std::uint64_t>(std::size_t{1} << kBinBits);
  std::size_t lower_bin_ = 0;
  std::size_t upper_bin_ = 0;
  std::size_t num_below_ = 0;   ///< Values in bins below lower_bin_.
  std::vector<double> middle_;  ///< Values of the bins that hold the middle.
};

/// Calls visit(translation_m, rotation_rad) for all i < j. E_ij is multiplied out so that a pair costs four 3×3
/// products: with R, r the reference and S, s the estimate, its rotation is R_jᵀ (R_i S_iᵀ) S_j and its translation
/// R_jᵀ (R_i S_iᵀ (s_j − s_i) − R_i R_iᵀ (r_j − r_i)).
template <typename Visit>
void for_each_pair(const Trajectory& reference, const Trajectory& estimate, Visit visit) {
  for (std::size_t i = 0; i < reference.size(); ++i) {
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
}

}  // namespace

AllPairsRpe all_pairs_rpe(const Trajectory& reference, const Trajectory& estimate) {
  internal::validate_poses(reference, estimate);
  if (reference.size() < 2) throw InvalidArgument("relative pose errors need at least two poses, there is one");
  StreamedStatistics translation;
  StreamedStatistics rotation;
  for_each_pair(reference, estimate, [&](double translation_m, double rotation_rad) {
    translation.first_pass(translation_m);
    rotation.first_pass(rotation_rad);
  });
  translation.end_first_pass();
  rotation.end_first_pass();
  for_each_pair(reference, estimate, [&](double translation_m, double rotation_rad) {
    translation.second_pass(translation_m);
    rotation.second_pass(rotation_rad);
  });
  return {.translation_m = translation.result(), .rotation_rad = rotation.result()};
}

}  // namespace trysquare
