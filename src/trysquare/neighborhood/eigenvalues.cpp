// SPDX-License-Identifier: Apache-2.0
#include "trysquare/neighborhood/eigenvalues.h"

#include "trysquare/core/error.h"
#include "trysquare/neighborhood/internal/vector_kernels.h"

#include <fmt/format.h>

namespace trysquare {

void eigenvalues(std::span<const Moments> moments, std::span<Eigen::Vector3d> eigenvalues) {
  if (moments.size() != eigenvalues.size()) {
    throw InvalidArgument(
        fmt::format("{} neighborhoods but room for the eigenvalues of {}", moments.size(), eigenvalues.size()));
  }
  vector_kernels().front().eigenvalues(moments, eigenvalues);
}

}  // namespace trysquare
