// SPDX-License-Identifier: BSD-3-Clause
#include "callback_threads.h"

namespace cabinet_articulation {
namespace {

const ros::WallDuration kPatience(1);

}  // namespace

void CallbackThreads::start(int threads) {
  for (int i = 0; i < threads; ++i)
    threads_.emplace_back([this] {
      while (!ends_) queue_.callOne(kPatience);
    });
}

void CallbackThreads::stop() {
  ends_ = true;
  queue_.disable();  // wakes the threads
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
}

}  // namespace cabinet_articulation
