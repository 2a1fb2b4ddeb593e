// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <csignal>

namespace trysquare::app {

/// Thrown where work stops because the user pressed Ctrl-C: what is half done is cleaned up on the way out.
struct Interrupted {
  int signal = SIGINT;
};

/// While it lives, SIGINT and SIGTERM do not end the process at once. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  Interruption(Interruption&&) = delete;
  Interruption& operator=(Interruption&&) = delete;

  /// @throws Interrupted  if a signal has come. May be called from several threads.
  void check() const;

 private:
  using Handler = void (*)(int);
  Handler old_interrupt_;
  Handler old_terminate_;
};

}  // namespace trysquare::app
