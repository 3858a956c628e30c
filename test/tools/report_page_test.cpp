// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "cabinet_articulation/joints/joint.h"
#include "support/models.h"
#include "tools/report/page.h"
#include "tools/report_document.h"

namespace cabinet_articulation {
namespace {

const Eigen::Vector3d kUpwards = -Eigen::Vector3d::UnitY();  // in an optical frame

core::PipelineResult resultOf(const std::vector<core::LearnedModel>& models, double stamp, bool seen) {
  core::PipelineResult result;
  result.models = models;
  result.milliseconds.planes = 4;
  result.frame.camera = {64, 48, 60, 60, 32, 24, 0.08, 0};
  result.frame.left = cv::Mat1b(48, 64, std::uint8_t{90});
  for (const core::LearnedModel& model : models) {
    core::TrackUpdate update;
    update.track.id = model.id;
    core::TrackedObservation observation;
    observation.stamp = seen ? stamp : stamp - 1;
    observation.rectangle = frontAt(model, model.q);
    update.track.observations = {observation};
    result.track_updates.push_back(update);
  }
  return result;
}

TEST(RunRecord, TellsWhenAFrontWasNotSeen) {
  RunRecord record;
  for (int i = 0; i < 10; ++i)
    record.add(100 + i,
               resultOf(i < 2 ? std::vector<core::LearnedModel>() : std::vector{test::doorModel()}, 100 + i, i < 4 || i == 7));
  record.close();
  ASSERT_EQ(record.moved().size(), 1U);
  const FrontRecord& door = *record.moved().front();
  ASSERT_EQ(door.unseen.size(), 3U);
  EXPECT_EQ(door.unseen[0].from, 0);
  EXPECT_EQ(door.unseen[0].to, 2);
  EXPECT_EQ(door.unseen[1].from, 3);
  EXPECT_EQ(door.unseen[1].to, 7);
  EXPECT_EQ(door.unseen[2].to, 9);
  EXPECT_EQ(door.observations.count(), 3U);
  EXPECT_EQ(*door.first_joint, 2);
}

TEST(RunRecord, GoesOnWhereTimeJumpsBack) {
  RunRecord record;
  for (const double stamp : {100, 101, 102, 5, 6}) record.add(stamp, resultOf({test::doorModel()}, stamp, true));
  EXPECT_EQ(record.end(), 4);
  EXPECT_TRUE(record.moved().front()->unseen.empty());
}

TEST(RunRecord, SamplesOfAHangingFrontAreInTheFrameOfItsParentOfThatTime) {
  RunRecord record;
  core::LearnedModel parent = test::doorModel(), drawer = test::drawerModel();
  for (int i = 0; i < 20; ++i) {
    core::PipelineResult result;
    parent.q = 0.05 * i;
    drawer.parent = i < 10 ? 0 : parent.id;
    drawer.q = 0.01 * i;
    result = resultOf({parent, drawer}, 100 + i, true);
    for (core::TrackUpdate& update : result.track_updates)
      if (update.track.id == drawer.id && i >= 10) {
        core::Rectangle& seen = update.track.observations[0].rectangle;
        seen.pose = parent.predict(parent.q) * seen.pose;
      }
    record.add(100 + i, result);
  }
  const FrontRecord& front = *record.moved()[1];
  ASSERT_EQ(front.model.id, drawer.id);
  EXPECT_EQ(front.hangs_since.value_or(0), 10);
  EXPECT_EQ(front.first_seen, 0);
  const std::vector<FrontSample> samples = front.observations.values();
  ASSERT_EQ(samples.size(), 10U) << "of one frame alone";
  for (std::size_t i = 0; i < samples.size(); ++i)
    EXPECT_NEAR(drawer.configuration(samples[i].rectangle.pose), 0.1 + 0.01 * static_cast<double>(i), 1e-9);
}

TEST(RunRecord, MemoryIsBounded) {
  RunRecord record;
  for (int i = 0; i < 3000; ++i) {
    core::LearnedModel door = test::doorModel(), still = test::restingModel();
    door.id = static_cast<std::uint32_t>(10 + i);
    still.id = static_cast<std::uint32_t>(10000 + i);
    record.add(100 + i, resultOf({door, still}, 100 + i, true));
  }
  EXPECT_LT(record.moved().size(), 100U);
  EXPECT_EQ(record.moved().size() + static_cast<std::size_t>(record.leftOut()), 3000U);
  EXPECT_LT(record.times().size(), 700U);
}

TEST(Page, IsWellFormedAndHasAllThatMoved) {
  core::LearnedModel named = test::doorModel();
  named.name = "fridge <left> & \"best\"";
  named.covariance = core::Matrix6d::Identity() * 1e-6;
  const std::vector<core::LearnedModel> models{named, test::drawerModel(), test::garageModel(), test::unexplainedModel(),
                                               test::restingModel()};
  RunRecord record;
  RunSummary summary;
  FramePictures pictures;
  for (int i = 0; i < 5; ++i) {
    const core::PipelineResult result = resultOf(models, i, true);
    summary.add(result);
    pictures.add(record.end(), result, Eigen::Isometry3d::Identity(), record.add(i, result));
  }
  record.close();
  const RunFacts facts{"a&b.bag", "process_bag a&b.bag <out>",   "stereo", "left_optical",
                       kUpwards,  "skipped 1 frames: \"none\"\n"};
  const std::string page = reportPage(facts, record, pictures, summary);
  const auto tree = test::parsed(page);
  std::string headings;
  for (const auto& heading : test::elements(tree, "h2")) headings += heading.data() + "\n";
  EXPECT_EQ(headings, "Joints\nFrames\nFront 3, fridge <left> & \"best\"\nFront 4\nFront 5\nFront 6\nTimes\n");
  EXPECT_EQ(test::elements(tree, "svg").size(), 4 * 5U + 1U);
  EXPECT_EQ(test::elements(tree, "img").size(), 5U + 3U) << "all frames, and the first one of each joint";
  EXPECT_EQ(page.find("http"), std::string::npos) << "nothing is fetched";
  EXPECT_EQ(page.find("nan"), std::string::npos) << "nothing is drawn nowhere";
  EXPECT_NE(page.find("planes</td><td>4.00</td>"), std::string::npos);
  EXPECT_NE(page.find("skipped 1 frames"), std::string::npos);
}

TEST(Page, SaysThatNothingMoved) {
  RunRecord record;
  RunSummary summary;
  FramePictures pictures;
  const core::PipelineResult result = resultOf({test::restingModel()}, 1, true);
  summary.add(result);
  pictures.add(0, result, Eigen::Isometry3d::Identity(), record.add(1, result));
  record.close();
  const std::string page = reportPage({"a.bag", "", "depth", "", kUpwards, ""}, record, pictures, summary);
  EXPECT_NO_THROW(test::parsed(page));
  EXPECT_NE(page.find("Nothing moved."), std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation
