// SPDX-License-Identifier: Apache-2.0
#include "trysquare/parallel/for_each_block.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>

namespace trysquare {
namespace {

/// Counts finished items and tells the callback, one call at a time.
class Progress {
 public:
  Progress(const ProgressCallback& callback, std::string_view stage, std::size_t total)
      : callback_(callback), stage_(stage), total_(total) {
    if (callback_) callback_(stage_, 0, total_);
  }

  void finished(std::size_t num_items) {
    if (!callback_) return;
    const std::scoped_lock lock(mutex_);
    done_ += num_items;
    callback_(stage_, done_, total_);
  }

 private:
  const ProgressCallback& callback_;
  std::string_view stage_;
  std::size_t total_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

/// Keeps what the block with the lowest index threw, so that an error does not depend on the threads either.
class FirstError {
 public:
  /// False when a block before this one has failed: the work of this one is not needed any more.
  bool is_needed(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    return !error_ || index < index_;
  }
  void keep(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    if (error_ && index_ <= index) return;
    error_ = std::current_exception();
    index_ = index;
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
  std::size_t index_ = 0;
};

}  // namespace

void for_each_block(std::size_t num_items, std::size_t block_size, const Execution& execution, std::string_view stage,
                    const std::function<void(const Block&)>& body) {
  execution.validate();
  const std::size_t count = num_blocks(num_items, block_size);
  Progress progress(execution.progress, stage, num_items);
  FirstError first_error;
  const auto run = [&](std::size_t index) {
    const std::size_t begin = index * block_size;
    const std::size_t end = std::min(begin + block_size, num_items);
    if (!first_error.is_needed(index)) return;
    try {
      body({index, begin, end});
      progress.finished(end - begin);
    } catch (...) {
      first_error.keep(index);
    }
  };
  if (execution.num_threads == 1 || count <= 1) {
    for (std::size_t index = 0; index < count; ++index) run(index);
    first_error.rethrow();
    return;
  }
  // At most so many threads, each taking the next block when it is done with one. No arena of our own: oneTBB 2021.8
  // loses 7 kB with each one that is destroyed, and our users' limits on its threads hold here, too.
  const auto num_threads = static_cast<std::size_t>(execution.num_threads == 0 ? tbb::this_task_arena::max_concurrency()
                                                                               : execution.num_threads);
  std::atomic<std::size_t> next_block = 0;
  const auto take_blocks = [&](std::size_t /*thread*/) {
    for (std::size_t index = next_block++; index < count; index = next_block++) run(index);
  };
  // Isolated: a thread that waits for blocks within a block must not begin another one of the outer call.
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, std::min(count, num_threads), std::size_t{1}, take_blocks,
                      tbb::simple_partitioner());
  });
  first_error.rethrow();
}

}  // namespace trysquare
