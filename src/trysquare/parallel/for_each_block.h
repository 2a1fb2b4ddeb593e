// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "trysquare/core/execution.h"

#include <cstddef>
#include <functional>
#include <string_view>

namespace trysquare {

/// Items [begin, end) of a range that was cut into blocks of equal size.
struct Block {
  std::size_t index = 0;
  std::size_t begin = 0;
  std::size_t end = 0;  ///< One past the last item.
};

/// Number of blocks that for_each_block makes of `num_items`.
constexpr std::size_t num_blocks(std::size_t num_items, std::size_t block_size) {
  return (num_items + block_size - 1) / block_size;
}

/// Runs `body` once for every block of `block_size` items, on several threads, in no fixed order.
///
/// Blocks do not depend on the number of threads. A caller that writes per block and combines in the order of
/// Block::index therefore gets bit-identical results for every Execution.
///
/// @param num_items   Items in the range; 0 runs nothing.
/// @param block_size  >= 1.
/// @param execution   Threads; its progress callback hears `stage` and finished items of `num_items`.
/// @param body        Called from several threads at once, on distinct blocks. What the first block that fails throws
///                    reaches the caller, whatever the threads.
/// @throws InvalidArgument  if `execution` is out of range.
void for_each_block(std::size_t num_items, std::size_t block_size, const Execution& execution, std::string_view stage,
                    const std::function<void(const Block&)>& body);

}  // namespace trysquare
