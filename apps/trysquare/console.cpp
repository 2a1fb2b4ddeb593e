// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace trysquare::app {
namespace {

using Clock = std::chrono::steady_clock;

void print_labelled(const char* label, const char* color, std::string_view message) {
  if (may_use_color(2)) {
    fmt::print(stderr, "\033[{}m{}:\033[0m {}\n", color, label, message);
  } else {
    fmt::print(stderr, "{}: {}\n", label, message);
  }
}

class ProgressBar {
 public:
  ProgressBar(bool rewrites_line, bool shows_short_work)
      : rewrites_line_(rewrites_line), shows_all_(shows_short_work) {}

  void update(std::string_view stage, std::size_t done, std::size_t total) {
    const Clock::time_point now = Clock::now();
    if (stage != stage_ || done == 0) {
      stage_ = stage;
      started_ = now;
      last_drawn_ = now;
    }
    if (done >= total) {
      finish(total, std::chrono::duration<double>(now - started_).count());
    } else if (now - last_drawn_ >= interval()) {
      draw(done, total, std::chrono::duration<double>(now - started_).count());
      last_drawn_ = now;
    }
  }

 private:
  /// A log file gets a line every ten seconds instead of a bar that moves.
  Clock::duration interval() const {
    return rewrites_line_ ? std::chrono::milliseconds(500 / (drawn_ ? 4 : 1)) : std::chrono::milliseconds(10'000);
  }

  void draw(std::size_t done, std::size_t total, double elapsed_s) {
    constexpr std::size_t kWidth = 30;
    const double share = static_cast<double>(done) / static_cast<double>(total);
    const auto filled = static_cast<std::size_t>(share * kWidth);
    const double left_s = share > 0 ? elapsed_s * (1 - share) / share : 0;
    const std::string line = fmt::format("{:<14} [{}{}] {:3.0f} %  {} left", stage_, std::string(filled, '#'),
                                         std::string(kWidth - filled, '.'), 100 * share, duration(left_s));
    if (rewrites_line_) {
      fmt::print(stderr, "\r\033[K{}", line);
    } else {
      fmt::print(stderr, "{}\n", line);
    }
    std::fflush(stderr);
    drawn_ = true;
  }

  static std::string duration(double seconds) {
    const auto whole = static_cast<long>(seconds + 0.5);
    return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
  }

  void finish(std::size_t total, double elapsed_s) {
    if (drawn_ && rewrites_line_) fmt::print(stderr, "\r\033[K");
    if (shows_all_) fmt::print(stderr, "{:<14} {} done in {:.1f} s\n", stage_, total, elapsed_s);
    drawn_ = false;
  }

  bool rewrites_line_;
  bool shows_all_;
  bool drawn_ = false;
  std::string stage_;
  Clock::time_point started_;
  Clock::time_point last_drawn_;
};

}  // namespace

bool may_use_color(int stream) { return isatty(stream) == 1 && std::getenv("NO_COLOR") == nullptr; }

void print_error(std::string_view message) { print_labelled("error", "1;31", message); }

void print_warnings(const std::vector<Diagnostic>& warnings) {
  for (const Diagnostic& warning : warnings) {
    print_labelled("warning", "1;33", fmt::format("{} [{}]", warning.message, warning.code));
  }
}

void print_note(std::string_view message) { fmt::print(stderr, "{}\n", message); }

ProgressCallback progress_bar(ProgressMode mode) {
  const bool terminal = isatty(2) == 1;
  if (mode == ProgressMode::kNever || (mode == ProgressMode::kAuto && !terminal)) return {};
  const auto bar = std::make_shared<ProgressBar>(terminal, mode == ProgressMode::kAlways);
  return [bar](std::string_view stage, std::size_t done, std::size_t total) { bar->update(stage, done, total); };
}

}  // namespace trysquare::app
