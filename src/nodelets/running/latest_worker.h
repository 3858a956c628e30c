// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace cabinet_articulation {

/// A thread that always does the newest job: one that arrives while another still waits replaces it. So a stage that is
/// slower than the camera drops frames instead of falling behind. Safe to use from several threads.
class LatestWorker {
 public:
  using Job = std::function<void()>;

  LatestWorker() : thread_([this] { run(); }) {}
  ~LatestWorker() { stop(); }

  LatestWorker(const LatestWorker&) = delete;
  LatestWorker& operator=(const LatestWorker&) = delete;

  /// True if a job that was still waiting was dropped for this one. Jobs must not throw.
  bool put(Job job);

  /// Drops the job that waits, waits for the one that runs, and ignores all that come later. Not from within a job.
  void stop();

 private:
  void run();

  std::mutex mutex_;  ///< guards the three below
  std::condition_variable changed_;
  Job waiting_;  ///< empty if none waits
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace cabinet_articulation
