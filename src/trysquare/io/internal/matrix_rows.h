// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/pose_collector.h"

#include <string_view>

namespace trysquare::internal {

/// Adds the matrices of a text: four lines of 4 numbers each, or one line of 16. A text of three lines of 4, or of one
/// line of 12, holds one 3×4 matrix.
/// @throws IoError  naming the line.
void collect_matrices(std::string_view text, std::string_view name, PoseCollector& poses);

/// The same for a text that holds exactly one matrix.
void collect_one_matrix(std::string_view text, std::string_view name, PoseCollector& poses);

}  // namespace trysquare::internal
