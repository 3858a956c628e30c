// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace cabinet_articulation {

/// A thread that always works on the newest item: one that arrives while another still waits replaces it. So a stage that
/// is slower than the camera drops frames instead of falling behind.
template <class Item>
class LatestWorker {
 public:
  explicit LatestWorker(std::function<void(const Item&)> work) : work_(std::move(work)), thread_([this] { run(); }) {}

  /// Waits for the item in work, drops the one that waits.
  ~LatestWorker() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }

  LatestWorker(const LatestWorker&) = delete;
  LatestWorker& operator=(const LatestWorker&) = delete;

  /// True if an item that was still waiting was dropped for this one.
  bool put(Item item) {
    bool dropped;
    {
      std::lock_guard<std::mutex> lock(mutex_);
      dropped = waiting_.has_value();
      waiting_ = std::move(item);
    }
    changed_.notify_one();
    return dropped;
  }

 private:
  void run() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return stopping_ || waiting_; });
      if (stopping_) return;
      const Item item = std::move(*waiting_);
      waiting_.reset();
      lock.unlock();
      work_(item);
      lock.lock();
    }
  }

  std::function<void(const Item&)> work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Item> waiting_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace cabinet_articulation
