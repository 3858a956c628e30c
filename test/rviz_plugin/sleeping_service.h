// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <condition_variable>
#include <mutex>
#include <string>

namespace cabinet_articulation {
namespace test {

/// Answers in a thread of its own, and not before it is woken.
class SleepingService {
 public:
  explicit SleepingService(const std::string& name) {
    nh_.setCallbackQueue(&queue_);
    server_ = nh_.advertiseService(name, &SleepingService::answer, this);
    spinner_.start();
  }

  ~SleepingService() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      over_ = true;
    }
    woken_.notify_all();
    spinner_.stop();
  }

  int calls() {
    std::lock_guard<std::mutex> lock(mutex_);
    return calls_;
  }

  void wakeOnce() {
    {
      std::lock_guard<std::mutex> lock(mutex_);
      ++answers_;
    }
    woken_.notify_all();
  }

 private:
  bool answer(std_srvs::Trigger::Request& /*request*/, std_srvs::Trigger::Response& response) {
    std::unique_lock<std::mutex> lock(mutex_);
    const int call = ++calls_;
    woken_.wait(lock, [&] { return over_ || answers_ >= call; });
    response.success = true;
    return true;
  }

  std::mutex mutex_;  ///< guards the next four
  std::condition_variable woken_;
  int calls_ = 0, answers_ = 0;
  bool over_ = false;
  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  ros::ServiceServer server_;
  ros::AsyncSpinner spinner_{1, &queue_};
};

}  // namespace test
}  // namespace cabinet_articulation
