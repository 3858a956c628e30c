// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/running/latest_worker.h"

#include <utility>

namespace cabinet_articulation {

bool LatestWorker::put(Job job) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (stopping_) return false;
    waiting_.swap(job);
  }
  changed_.notify_one();
  return static_cast<bool>(job);
}

void LatestWorker::stop() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
    waiting_ = nullptr;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void LatestWorker::run() {
  while (true) {
    Job job;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || waiting_; });
      if (stopping_) return;
      job = std::exchange(waiting_, nullptr);
    }
    job();
  }
}

}  // namespace cabinet_articulation
