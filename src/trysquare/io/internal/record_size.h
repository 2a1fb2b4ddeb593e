// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/io/internal/text.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace trysquare::internal {

/// A header's claim against the bytes at hand, before memory is taken for it.
/// @throws IoError  if `num_records` of `stride` bytes are more than `body` holds.
void require_bytes_for(std::uint64_t num_records, std::size_t stride, std::string_view body, std::size_t body_offset,
                       std::string_view name);

/// The same for text, where a value takes two bytes at least: a digit and what parts it from the next one.
/// @throws IoError  if the text behind `lines` is too short for `num_records` lines of `num_values` numbers.
void require_text_for(std::uint64_t num_records, std::size_t num_values, std::string_view text, const LineReader& lines,
                      std::string_view name);

}  // namespace trysquare::internal
