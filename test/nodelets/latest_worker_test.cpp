// SPDX-License-Identifier: BSD-3-Clause
#include "latest_worker.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

namespace cabinet_articulation {
namespace {

TEST(LatestWorker, WorksOnEveryItemIfItIsFastEnough) {
  std::promise<int> done;
  LatestWorker<int> worker([&](const int& item) { done.set_value(item); });
  for (int item = 1; item <= 3; ++item) {
    done = std::promise<int>();
    EXPECT_FALSE(worker.put(item));
    EXPECT_EQ(done.get_future().get(), item);
  }
}

TEST(LatestWorker, KeepsOnlyTheNewestWhileItIsBusy) {
  std::promise<void> started, release, finished;
  std::vector<int> worked;
  LatestWorker<int> worker([&](const int& item) {
    worked.push_back(item);
    if (worked.size() == 1) {
      started.set_value();
      release.get_future().wait();
    } else {
      finished.set_value();
    }
  });
  EXPECT_FALSE(worker.put(1));
  started.get_future().wait();
  EXPECT_FALSE(worker.put(2)) << "2 waits";
  EXPECT_TRUE(worker.put(3)) << "2 is dropped";
  EXPECT_TRUE(worker.put(4)) << "3 is dropped";
  release.set_value();
  finished.get_future().wait();
  EXPECT_EQ(worked, (std::vector<int>{1, 4}));
}

TEST(LatestWorker, EndsWhileAnItemWaits) {
  std::promise<void> started, release;
  int worked = 0;
  std::thread releaser;
  {
    LatestWorker<int> worker([&](const int&) {
      if (++worked > 1) return;
      started.set_value();
      release.get_future().wait();
    });
    worker.put(1);
    started.get_future().wait();
    worker.put(2);
    releaser = std::thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      release.set_value();
    });
  }
  releaser.join();
  EXPECT_LE(worked, 2);
  EXPECT_GE(worked, 1);
}

}  // namespace
}  // namespace cabinet_articulation
