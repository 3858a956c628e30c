// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ExpectedFrontArray.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

namespace cabinet_articulation {

/// What the tracker expects, and a wait for what it says after a certain frame. Safe to use from several threads.
class ExpectedInbox {
 public:
  struct Answer {
    ExpectedFrontArrayConstPtr fronts;  ///< the newest; null before the first
    double waited = 0;                  ///< [s]
    bool in_time = true;                ///< `fronts` are what was waited for
  };

  void put(const ExpectedFrontArrayConstPtr& fronts) {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      newest_ = fronts;
    }
    came_.notify_all();
  }

  /// Waits at most `patience` [s] for what was said after the frame of `stamp`.
  Answer after(const ros::Time& stamp, double patience) {
    const auto start = std::chrono::steady_clock::now();
    std::unique_lock<std::mutex> lock(mutex_);
    const auto is_there = [&] { return newest_ && newest_->header.stamp == stamp; };
    came_.wait_for(lock, std::chrono::duration<double>(patience), [&] { return interrupted_ || is_there(); });
    return {newest_, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), is_there()};
  }

  void clear() {
    std::lock_guard<std::mutex> lock(mutex_);
    newest_.reset();
  }

  /// Ends the wait that goes on, and every later one.
  void interrupt() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      interrupted_ = true;
    }
    came_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable came_;
  ExpectedFrontArrayConstPtr newest_;
  bool interrupted_ = false;
};

}  // namespace cabinet_articulation
