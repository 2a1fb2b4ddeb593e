// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/neighborhood/moments.h"

#include <Eigen/Core>

#include <span>

namespace trysquare {

/// Eigenvalues λ₁ <= λ₂ <= λ₃ [m²] of the covariances of many neighborhoods, clamped at 0: rounding must not make a
/// variance negative. Jacobi's method on several covariances at a time.
///
/// @param moments      M neighborhoods.
/// @param eigenvalues  M triples in ascending order, overwritten.
/// @throws InvalidArgument  if the lengths differ.
///
/// Accuracy: each within 4e-16 λ₃ of the exact one. Source: Golub & Van Loan, Matrix Computations, §8.5.
void eigenvalues(std::span<const Moments> moments, std::span<Eigen::Vector3d> eigenvalues);

}  // namespace trysquare
