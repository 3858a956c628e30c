// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/running/callback_threads.h"

#include <memory>
#include <mutex>

namespace cabinet_articulation {
namespace {

const ros::WallDuration kPoll(1);  // [s] ours: the end of the queue wakes the threads, so any length does

/// Reachable to the end, so that it is no leak.
ros::CallbackQueue* newQueue() {
  static std::mutex mutex;
  static auto* const queues = new std::vector<std::unique_ptr<ros::CallbackQueue>>;
  std::lock_guard<std::mutex> lock(mutex);
  queues->push_back(std::make_unique<ros::CallbackQueue>());
  return queues->back().get();
}

}  // namespace

CallbackThreads::CallbackThreads() : queue_(newQueue()) {}

void CallbackThreads::start(int threads) {
  for (int i = 0; i < threads; ++i)
    threads_.emplace_back([this] {
      while (!ends_) queue_->callOne(kPoll);
    });
}

void CallbackThreads::stop() {
  ends_ = true;
  queue_->disable();  // wakes the threads
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

}  // namespace cabinet_articulation
