// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>

#include <atomic>
#include <thread>
#include <vector>

namespace cabinet_articulation {

/*
 * A queue of callbacks and the threads that serve it.
 *
 * Stages need their own: nodeletlib frees a nodelet's queues when it is unloaded, but a callback that runs then keeps the nodelet
 * alive, whose end would use queues that are gone. And it drops what comes while a nodelet is started: a service that is called
 * by then would never answer.
 *
 * A queue is never freed, some 200 bytes for each stage that was unloaded: roscpp may add to the queue of a service or publisher
 * shortly after it was shut down.
 */
class CallbackThreads {
 public:
  CallbackThreads();
  CallbackThreads(const CallbackThreads&) = delete;
  CallbackThreads& operator=(const CallbackThreads&) = delete;
  ~CallbackThreads() { stop(); }

  /// For NodeHandle::setCallbackQueue(). Keeps what comes before start().
  ros::CallbackQueue* queue() { return queue_; }

  void start(int threads);

  /// Waits for callbacks that run. No later one does.
  void stop();

 private:
  ros::CallbackQueue* const queue_;
  std::atomic<bool> ends_{false};
  std::vector<std::thread> threads_;
};

}  // namespace cabinet_articulation
