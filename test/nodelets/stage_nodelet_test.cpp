// SPDX-License-Identifier: BSD-3-Clause
// How a stage ends, without a master.
#include "nodelets/stages/stage_nodelet.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

namespace cabinet_articulation {
namespace {

/// What happened, in this order.
class Events {
 public:
  void add(const std::string& event) {
    std::lock_guard<std::mutex> lock(mutex_);
    events_.push_back(event);
  }

  std::vector<std::string> all() const {
    std::lock_guard<std::mutex> lock(mutex_);
    return events_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> events_;
};

/// Calls a function when it is destroyed.
std::shared_ptr<void> whenDestroyed(const std::function<void()>& call) {
  return std::shared_ptr<void>(nullptr, [call](void*) { call(); });
}

class RecordingStage : public StageNodelet {
 public:
  RecordingStage(Events* events, const std::function<void()>& member_destroyed)
      : StageNodelet("recording"), events_(*events), member_(whenDestroyed(member_destroyed)) {}

  using StageNodelet::workOnAll;
  using StageNodelet::workOnNewest;

  int dropped() {
    diagnostic_updater::DiagnosticStatusWrapper status;
    health().describe(0, &status);
    for (const diagnostic_msgs::KeyValue& value : status.values)
      if (value.key == "frames dropped for newer ones") return std::stoi(value.value);
    return -1;
  }

 private:
  void start() override {}
  void subscribe() override {}
  void unsubscribe() override { events_.add("unsubscribe"); }
  void interrupt() override { events_.add("interrupt"); }
  void finish() override { events_.add("finish"); }

  Events& events_;
  std::shared_ptr<void> member_;  ///< stands for all that jobs and callbacks use
};

static_assert(std::is_abstract_v<RecordingStage>, "a stage that nothing ends in order must not compile");
static_assert(!std::is_abstract_v<EndsInOrder<RecordingStage>>);

/// Holds a job until it is released, once or more often.
class Latch {
 public:
  void run() {
    started_.set_value();
    release_.get_future().wait();
  }

  void waitForStart() { started_.get_future().wait(); }

  void release() {
    std::call_once(once_, [this] { release_.set_value(); });
  }

 private:
  std::promise<void> started_, release_;
  std::once_flag once_;
};

// The running job ends when the waiting one is dropped, that is, when the worker is told to stop. Were the stage's member
// destroyed before, that would end the job, too, and show in the order.
TEST(StageNodelet, JoinsItsWorkerBeforeAMemberIsDestroyed) {
  Events events;
  Latch latch;
  auto stage = std::make_unique<EndsInOrder<RecordingStage>>(&events, [&] {
    events.add("member destroyed");
    latch.release();
  });
  stage->workOnNewest([&] {
    latch.run();
    events.add("job ended");
  });
  latch.waitForStart();
  stage->workOnNewest([drop = whenDestroyed([&] { latch.release(); })] {});
  stage.reset();
  EXPECT_EQ(events.all(), (std::vector<std::string>{"interrupt", "unsubscribe", "job ended", "finish", "member destroyed"}));
}

TEST(StageNodelet, CountsDroppedJobsButNotThoseThatTheNextOneDoes) {
  Events events;
  Latch latch;
  EndsInOrder<RecordingStage> stage(&events, [] {});
  stage.workOnNewest([&] { latch.run(); });
  latch.waitForStart();
  stage.workOnAll([] {});
  stage.workOnAll([] {});
  EXPECT_EQ(stage.dropped(), 0);
  stage.workOnNewest([] {});
  EXPECT_EQ(stage.dropped(), 1);
  latch.release();
}

/// Its job waits for what never comes.
class WaitingStage : public StageNodelet {
 public:
  WaitingStage() : StageNodelet("waiting") {}

  /// Returns while the job waits; tells whether the wait was cut short.
  std::future<bool> wait() {
    const auto waits = std::make_shared<std::promise<void>>();
    const auto cut_short = std::make_shared<std::promise<bool>>();
    workOnNewest([this, waits, cut_short] {
      std::unique_lock<std::mutex> lock(mutex_);
      waits->set_value();
      cut_short->set_value(changed_.wait_for(lock, std::chrono::seconds(30), [this] { return ending_; }));
    });
    waits->get_future().wait();
    return cut_short->get_future();
  }

 private:
  void start() override {}
  void subscribe() override {}
  void unsubscribe() override {}
  void interrupt() override {
    std::lock_guard<std::mutex> lock(mutex_);
    ending_ = true;
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool ending_ = false;
};

TEST(StageNodelet, CutsAWaitShortWhenItEnds) {
  std::future<bool> cut_short;
  {
    EndsInOrder<WaitingStage> stage;
    cut_short = stage.wait();
  }
  EXPECT_TRUE(cut_short.get());
}

}  // namespace
}  // namespace cabinet_articulation
