// SPDX-License-Identifier: Apache-2.0
#include "interruption.h"

#include <atomic>

namespace trysquare::app {
namespace {

std::atomic<int> signal_that_came = 0;  // what a signal handler may touch
static_assert(std::atomic<int>::is_always_lock_free);

void remember(int signal) { signal_that_came = signal; }

}  // namespace

Interruption::Interruption()
    : old_interrupt_(std::signal(SIGINT, remember)), old_terminate_(std::signal(SIGTERM, remember)) {
  if (old_interrupt_ == SIG_IGN) std::signal(SIGINT, SIG_IGN);  // in the background of a shell: it stays ignored
}

Interruption::~Interruption() {
  std::signal(SIGINT, old_interrupt_);
  std::signal(SIGTERM, old_terminate_);
}

void Interruption::check() const {
  if (const int signal = signal_that_came) throw Interrupted{signal};
}

}  // namespace trysquare::app
