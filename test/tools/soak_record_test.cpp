// SPDX-License-Identifier: BSD-3-Clause
#include "tools/truth/soak_record.h"

#include <cabinet_articulation/ArticulationModel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

using Outcome = Judgement::Outcome;

constexpr double kMinute = 60, kRun = 20 * kMinute;

/// A drawer that is pulled out along x, by 0.3 m and back again every 10 s.
class SoakRecordTest : public testing::Test {
 protected:
  SoakRecordTest() {
    truth_.joints.resize(1);
    truth_.joints[0].name = "drawer";
    truth_.joints[0].type = ArticulationModel::PRISMATIC;
    truth_.joints[0].width = 0.4;
    truth_.joints[0].height = 0.2;
    model_.id = 3;
    model_.type = core::JointType::kPrismatic;
    model_.moved = true;
    model_.axis = Eigen::Vector3d::UnitX();
    model_.q_max = 0.3;
    model_.width = 0.4;
    model_.height = 0.2;
    model_.observations = 100;
  }

  void add(double time, const std::vector<core::LearnedModel>& models) {
    const double q = 0.15 - 0.15 * std::cos(2 * M_PI * time / 10);
    truth_.joints[0].pose = toMessage(Eigen::Isometry3d(Eigen::Translation3d(q, 0, 0)));
    record_.addFrame(time, time / 2, truth_, models);
    record_.addMemory(time, memory_);
    for (const char* stage : {"stereo", "planes", "rectangles", "tracking", "articulation"})
      record_.addStage(time, stage, milliseconds_);
  }

  /// A frame a second, as it ought to be but for what `change` does to the models.
  void run(const std::function<void(double, std::vector<core::LearnedModel>*)>& change = {}, double duration = kRun) {
    for (double time = 0; time < duration; time += 1) {
      std::vector<core::LearnedModel> models{model_};
      if (change) change(time, &models);
      add(time, models);
    }
  }

  std::string failures(double duration = kRun) const { return failures({model_}, duration); }
  std::string failures(const std::vector<core::LearnedModel>& saved, double duration = kRun) const {
    std::string text;
    for (const Judgement& judgement : record_.judge(duration, saved, SoakLimits()))
      if (judgement.outcome == Outcome::kFailed) text += judgement.text + "\n";
    return text;
  }

  SceneTruth truth_;
  core::LearnedModel model_;
  bool is_remembered_ = false;
  SoakRecord record_{[this](std::uint32_t id) { return id == 3 && is_remembered_; }};
  double memory_ = 200, milliseconds_ = 20;
};

TEST_F(SoakRecordTest, WhatHoldsAllTheTimeIsGood) {
  run();
  const auto judgements = record_.judge(kRun, {model_}, SoakLimits());
  EXPECT_TRUE(allHeld(judgements)) << format(judgements);
  EXPECT_EQ(judgements.size(), 9u) << "a joint, what was saved, memory, objects and five stages";
  const std::string text = format(judgements);
  EXPECT_EQ(text.substr(text.size() - 16), "everything held\n");
  const std::string minute = record_.minute(kMinute, 2 * kMinute);
  for (const char* part : {"200.0", "2.0", "drawer: prismatic 100.0 %"})
    EXPECT_NE(minute.find(part), std::string::npos) << minute;
}

TEST_F(SoakRecordTest, AJointThatVanishesForTwoPerCentOfTheTimeIsNot) {
  run([](double time, auto* models) {
    if (time >= 600 && time < 624) models->clear();
  });
  EXPECT_NE(failures().find("drawer known in 98.00 %"), std::string::npos) << failures();
  EXPECT_NE(failures().find("unknown for up to 24.0 s, at 599.0 s"), std::string::npos) << failures();
}

TEST_F(SoakRecordTest, AJointThatIsOutOfSightIsKnownWhileItIsRemembered) {
  run([this](double time, auto* models) {
    is_remembered_ = true;
    if (time >= 600 && time < 840) models->clear();
  });
  EXPECT_EQ(failures(), "");
  const std::string text = format(record_.judge(kRun, {model_}, SoakLimits()));
  EXPECT_NE(text.find("(20.00 % from memory, out of sight)"), std::string::npos) << text;
}

TEST_F(SoakRecordTest, AJointThatIsSeenAndNotBelievedIsNotKnown) {
  run([this](double time, auto* models) {
    is_remembered_ = true;
    models->front().moved = time < 600;
  });
  EXPECT_NE(failures().find("drawer known in 50.00 %"), std::string::npos) << failures();
}

TEST_F(SoakRecordTest, ItTakesAsLongAsItTakesToBeKnown) {
  run([](double time, auto* models) { models->front().moved = time >= 400; });
  EXPECT_EQ(failures(), "");
}

TEST_F(SoakRecordTest, AJointThatIsNeverKnownIsSaid) {
  run([](double, auto* models) { models->front().explained = false; });
  EXPECT_NE(failures().find("drawer was never known"), std::string::npos) << failures();
}

TEST_F(SoakRecordTest, AnotherTypeIsWrongHoweverShort) {
  run([](double time, auto* models) {
    if (time != 605) return;
    // Where the drawer is open this hinge is far from it.
    models->front().type = core::JointType::kRotational;
    models->front().axis = Eigen::Vector3d::UnitZ();
    models->front().axis_point = Eigen::Vector3d(0, 0.05, 0);
    models->front().q_max = 1;
  });
  EXPECT_NE(failures().find("taken for rotational in 1 frames"), std::string::npos) << failures();
}

TEST_F(SoakRecordTest, LostFramesAreFramesInWhichNothingIsKnown) {
  run();
  for (double time = kRun; time < kRun + 24; time += 1) record_.addLostFrame(time, truth_);
  EXPECT_NE(failures().find("drawer known in 98.04 %"), std::string::npos) << failures();
}

TEST_F(SoakRecordTest, WhatIsSavedMustBeExactlyWhatMoves) {
  run();
  EXPECT_NE(failures(std::vector<core::LearnedModel>{}).find("saved: 0 fronts where 1 move without drawer"), std::string::npos);
  core::LearnedModel elsewhere = model_;
  elsewhere.origin.translation().y() = 1;
  EXPECT_NE(failures({elsewhere}).find("saved: 1 fronts where 1 move without drawer"), std::string::npos);
  EXPECT_NE(failures({model_, elsewhere}).find("saved: 2 fronts where 1 move"), std::string::npos);
}

TEST_F(SoakRecordTest, MemoryMayGrowForTenMinutes) {
  run([this](double time, auto*) { memory_ = 200 + std::min(time, 600.0) / 10; });
  EXPECT_EQ(failures(), "");
}

TEST_F(SoakRecordTest, MemoryMayNotGrowForEver) {
  run([this](double time, auto*) { memory_ = 200 + time / 100; });
  EXPECT_NE(failures().find("memory: 205.7 MB after 10 minutes, at most 211.7 MB later"), std::string::npos) << failures();
}

TEST_F(SoakRecordTest, NothingMayBecomeSlowerOrMore) {
  run([this](double time, auto* models) {
    milliseconds_ = 20 + 10 * time / kRun;
    models->resize(1 + static_cast<size_t>(time / 200), *models->begin());
  });
  const std::string text = failures();
  for (const char* what : {"stereo [ms]: median 23.", "articulation [ms]: median 23.", "objects: median 2.0 in"})
    EXPECT_NE(text.find(what), std::string::npos) << text;
}

TEST_F(SoakRecordTest, AShortRunIsNotJudgedOnGrowth) {
  run([this](double time, auto*) { memory_ = 200 + time; }, 5 * kMinute);
  EXPECT_EQ(failures(5 * kMinute), "");
  const std::string text = format(record_.judge(5 * kMinute, {model_}, SoakLimits()));
  EXPECT_NE(text.find("not judged"), std::string::npos) << text;
}

}  // namespace
}  // namespace cabinet_articulation
