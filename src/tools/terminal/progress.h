// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <chrono>
#include <cstdio>

namespace cabinet_articulation {

/// Frames done, their rate and the time left, in one line of a terminal; nothing where stderr is none.
class Progress {
 public:
  explicit Progress(size_t expected) : on_terminal_(isatty(STDERR_FILENO) == 1), expected_(expected), start_(Clock::now()) {}
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of those that were expected.
  void show(size_t done) {
    const Clock::time_point now = Clock::now();
    if (!on_terminal_ || seconds(shown_, now) < kPeriod) return;
    shown_ = now;
    const double rate = static_cast<double>(done) / seconds(start_, now);
    const double left = expected_ > done ? static_cast<double>(expected_ - done) / rate : 0;
    std::fprintf(stderr, "\r%zu of %zu frames, %.1f a second, %.0f s left\033[K", done, expected_, rate, left);
    std::fflush(stderr);
  }

  /// Before other words are printed.
  void clear() {
    if (on_terminal_ && shown_ != Clock::time_point()) std::fprintf(stderr, "\r\033[K");
    shown_ = {};
  }

 private:
  using Clock = std::chrono::steady_clock;

  static constexpr double kPeriod = 0.5;  ///< [s] that a person can read

  static double seconds(Clock::time_point from, Clock::time_point to) { return std::chrono::duration<double>(to - from).count(); }

  const bool on_terminal_;
  const size_t expected_;
  const Clock::time_point start_;
  Clock::time_point shown_;
};

}  // namespace cabinet_articulation
