// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/running/latest_worker.h"

#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <vector>

namespace cabinet_articulation {
namespace {

TEST(LatestWorker, DoesEveryJobIfItIsFastEnough) {
  LatestWorker worker;
  for (int job = 1; job <= 3; ++job) {
    std::promise<int> done;
    EXPECT_FALSE(worker.put([&done, job] { done.set_value(job); }));
    EXPECT_EQ(done.get_future().get(), job);
  }
}

TEST(LatestWorker, KeepsOnlyTheNewestWhileItIsBusy) {
  std::promise<void> started, release, finished;
  std::vector<int> done;
  LatestWorker worker;
  EXPECT_FALSE(worker.put([&] {
    done.push_back(1);
    started.set_value();
    release.get_future().wait();
  }));
  started.get_future().wait();
  EXPECT_FALSE(worker.put([&] { done.push_back(2); })) << "2 waits";
  EXPECT_TRUE(worker.put([&] { done.push_back(3); })) << "2 is dropped";
  EXPECT_TRUE(worker.put([&] {
    done.push_back(4);
    finished.set_value();
  })) << "3 is dropped";
  release.set_value();
  finished.get_future().wait();
  EXPECT_EQ(done, (std::vector<int>{1, 4}));
}

// The running job ends when the waiting one is dropped, that is, not before stop() was called.
TEST(LatestWorker, StopsAfterTheRunningJobAndDropsAllOthers) {
  std::promise<void> started, dropped;
  bool running_done = false, waiting_done = false, late_done = false;
  LatestWorker worker;
  worker.put([&] {
    started.set_value();
    dropped.get_future().wait();
    running_done = true;
  });
  started.get_future().wait();
  worker.put([&, drop = std::shared_ptr<void>(nullptr, [&](void*) { dropped.set_value(); })] { waiting_done = true; });
  worker.stop();
  EXPECT_TRUE(running_done);
  EXPECT_FALSE(worker.put([&] { late_done = true; }));
  worker.stop();
  EXPECT_FALSE(waiting_done);
  EXPECT_FALSE(late_done);
}

}  // namespace
}  // namespace cabinet_articulation
