// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/running/stage_health.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gtest/gtest.h>

namespace cabinet_articulation {
namespace {

using diagnostic_msgs::DiagnosticStatus;

diagnostic_updater::DiagnosticStatusWrapper describe(StageHealth& health, double now) {
  diagnostic_updater::DiagnosticStatusWrapper status;
  health.describe(now, &status);
  return status;
}

std::string valueOf(const DiagnosticStatus& status, const std::string& key) {
  for (const auto& entry : status.values)
    if (entry.key == key) return entry.value;
  return "missing";
}

TEST(StageHealth, IsIdleWhileNobodyListens) {
  StageHealth health;
  const auto status = describe(health, 100);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "idle: nobody subscribes to its results");
}

TEST(StageHealth, TellsRateAgeAndDroppedFrames) {
  StageHealth health;
  health.setActive(true, 0);
  describe(health, 0.5);
  for (int i = 0; i < 20; ++i) health.processed(0.08, 12.5, 0.5 + 0.1 * i);
  health.dropped();
  health.dropped();
  health.note("pixels with depth [%]", 41.25);
  const auto status = describe(health, 2.5);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "10.0 Hz, 80 ms old, 2 dropped");
  EXPECT_EQ(valueOf(status, "time for the last frame [ms]"), "12.5");
  EXPECT_EQ(valueOf(status, "frames processed"), "20");
  EXPECT_EQ(valueOf(status, "frames dropped for newer ones"), "2");
  EXPECT_EQ(valueOf(status, "pixels with depth [%]"), "41.25");
  EXPECT_EQ(valueOf(describe(health, 3.5), "rate [Hz]"), "0.0");
}

TEST(StageHealth, TroubleIsAWarningWhileFramesComeAndAnErrorWhenNoneDo) {
  StageHealth health;
  health.setActive(true, 0);
  health.processed(0.1, 5, 1);
  health.trouble("input", "P[3] is 0", 1.5);
  auto status = describe(health, 2);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "P[3] is 0");
  status = describe(health, 5);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(valueOf(status, "input"), "P[3] is 0");
  health.processed(0.1, 5, 7);
  EXPECT_EQ(describe(health, 7.5).level, DiagnosticStatus::OK) << "not reported any more";
}

TEST(StageHealth, NamesAllTroublesAtOnce) {
  StageHealth health;
  health.setActive(true, 0);
  health.trouble("a", "first", 1);
  health.trouble("b", "second", 1);
  EXPECT_EQ(describe(health, 2).message, "first; second");
}

TEST(StageHealth, AsksToLogATroubleNowAndThenAndEverLessOften) {
  StageHealth health;
  health.setActive(true, 0);
  EXPECT_TRUE(health.trouble("a", "differ by 33 ms", 1));
  EXPECT_FALSE(health.trouble("a", "differ by 34 ms", 2));
  EXPECT_TRUE(health.trouble("b", "something else", 2));
  EXPECT_TRUE(health.trouble("a", "differ by 35 ms", 11.5));
  EXPECT_FALSE(health.trouble("a", "differ by 36 ms", 21));
  EXPECT_FALSE(health.trouble("a", "differ by 36 ms", 31));
  EXPECT_TRUE(health.trouble("a", "differ by 36 ms", 32));
  EXPECT_TRUE(health.trouble("a", "differ by 37 ms", 100)) << "came back after it was gone";
}

TEST(StageHealth, SilenceWithoutAReasonIsAWarningToo) {
  StageHealth health;
  health.setActive(true, 10);
  EXPECT_EQ(describe(health, 12).level, DiagnosticStatus::OK);
  const auto status = describe(health, 14);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "no frame for 4 s");
}

TEST(StageHealth, LastingTroubleIsToldAlsoWhileIdleUntilItIsOver) {
  StageHealth health;
  health.setLasting("models_file", "is cut off");
  auto status = describe(health, 100);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, "is cut off");
  EXPECT_EQ(valueOf(status, "models_file"), "is cut off");
  health.trouble("set_parameters", "rate is -1", 100);
  EXPECT_EQ(describe(health, 100).message, "is cut off; rate is -1") << "a request that went wrong, too";
  health.setActive(true, 100);
  health.processed(0.1, 5, 101);
  health.trouble("input", "P[3] is 0", 101);
  EXPECT_EQ(describe(health, 102).message, "is cut off; P[3] is 0");
  health.setPaused(true, 103);
  EXPECT_EQ(describe(health, 103).level, DiagnosticStatus::WARN);
  health.setLasting("models_file", "");
  EXPECT_EQ(describe(health, 103).level, DiagnosticStatus::OK);
}

TEST(StageHealth, PausedTimeIsNoTrouble) {
  StageHealth health;
  health.setActive(true, 0);
  health.processed(0.1, 5, 1);
  health.setPaused(true, 2);
  const auto status = describe(health, 1000);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_NE(status.message.find("simulated time stands still"), std::string::npos);
  health.setPaused(false, 1000);
  EXPECT_EQ(describe(health, 1002).level, DiagnosticStatus::OK) << "time to begin again";
}

TEST(StageHealth, RecognisesStampsOfAnotherClock) {
  StageHealth health;
  health.setActive(true, 0);
  health.processed(1.6e9, 5, 1);
  const auto status = describe(health, 1.5);
  EXPECT_EQ(status.level, DiagnosticStatus::WARN);
  EXPECT_NE(status.message.find("a bag is played without /use_sim_time"), std::string::npos);
}

TEST(StageHealth, RefusalStays) {
  StageHealth health;
  health.refuse("setting 'stride' is 0 px, allowed is 1 to 32 px");
  const auto status = describe(health, 1000);
  EXPECT_EQ(status.level, DiagnosticStatus::ERROR);
  EXPECT_EQ(status.message, "not running: setting 'stride' is 0 px, allowed is 1 to 32 px");
}

}  // namespace
}  // namespace cabinet_articulation
