// SPDX-License-Identifier: BSD-3-Clause
// Models that outlive the nodelet that learned them.
#include <cabinet_articulation/KnownFrontArray.h>
#include <cabinet_articulation/LoadModels.h>
#include <cabinet_articulation/SaveModels.h>
#include <std_srvs/Trigger.h>

#include <algorithm>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/model_file_fixture.h"

namespace cabinet_articulation {
namespace {

namespace fs = std::filesystem;
using test::kName;
using test::ModelFile;
using test::Recorder;
using test::spinUntil;

TEST_F(ModelFile, IsWrittenAtTheEndAndKnownAtTheStart) {
  ASSERT_TRUE(play(100));
  const Predict::Response before = predict(tracks_[0].id, 0.8);
  ASSERT_TRUE(before.success) << before.message;
  restart();
  ASSERT_TRUE(fs::exists(path_));
  const Predict::Response after = predict(tracks_[0].id, 0.8);
  ASSERT_TRUE(after.success) << after.message;
  EXPECT_EQ(after.header.frame_id, "map");
  EXPECT_LT((fromMessage(after.poses.at(0).pose).translation() - fromMessage(before.poses.at(0).pose).translation()).norm(),
            1e-6);
  EXPECT_FALSE(predict(tracks_[2].id, 0).success) << "the wall is no joint";

  // The tracker hears of the fronts, and gives the ones it sees again their ids and history back.
  const Recorder<KnownFrontArray> known("/cabinet/known_fronts");
  ASSERT_TRUE(spinUntil([&] { return !known.messages.empty(); }));
  ASSERT_EQ(known.messages.back()->tracks.size(), 2u);
  EXPECT_EQ(known.messages.back()->header.frame_id, "map");
  generation_ = known.messages.back()->generation;
  core::Track door = wholeTrack(known.messages.back()->tracks[0]);
  EXPECT_EQ(door.id, tracks_[0].id);
  EXPECT_EQ(door.observations.size(), static_cast<size_t>(test::kFrames));
  observe(&door, test::doorPose(0.3), 1000);
  tracks_ = {door};
  const ArticulationModelArrayConstPtr models = publish(1000);
  ASSERT_TRUE(models);
  ASSERT_EQ(models->models.size(), 1u);
  EXPECT_TRUE(models->models[0].moved);
  EXPECT_EQ(models->models[0].observations, test::kFrames + 1u) << "continues";
  EXPECT_NEAR(models->models[0].q, 0.3, 0.01);
}

/// The second leaf of a folding door, of which the door is the first.
Eigen::Isometry3d leafPose(double q) {
  return test::doorPose(q) * Eigen::Translation3d(0.2, 0, 0) * Eigen::AngleAxisd(2 * q, Eigen::Vector3d::UnitY()) *
         Eigen::Translation3d(0.2, 0, 0);
}

TEST_F(ModelFile, KeepsWhatAFrontHangsOnAndRefusesACycle) {
  tracks_.resize(2);
  tracks_[1].height = 0.6;
  const std::string door = std::to_string(tracks_[0].id), leaf = std::to_string(tracks_[1].id);
  ArticulationModelArrayConstPtr models;
  for (int i = 0; i < 90; ++i) {
    const double stamp = 700 + i / 15.0, q = 0.8 * std::max(0, i - 15) / 74.0;
    observe(&tracks_[0], test::doorPose(q), stamp);
    observe(&tracks_[1], leafPose(q), stamp);
    models = publish(stamp);
  }
  ASSERT_TRUE(models);
  ASSERT_EQ(models->models.size(), 2u);
  EXPECT_EQ(models->models[0].parent, 0u);
  ASSERT_EQ(models->models[1].parent, tracks_[0].id);
  EXPECT_GT(models->models[1].parent_probability, 0.99);
  const double q = models->models[1].q;
  const Predict::Response before = predict(tracks_[1].id, q);
  ASSERT_TRUE(before.success) << before.message;
  EXPECT_EQ(before.header.frame_id, "map");
  EXPECT_LT((fromMessage(before.poses.at(0).pose).translation() - leafPose(0.8).translation()).norm(), 0.005);
  restart();
  const Predict::Response after = predict(tracks_[1].id, q);
  ASSERT_TRUE(after.success) << after.message;
  EXPECT_LT((fromMessage(after.poses.at(0).pose).translation() - fromMessage(before.poses.at(0).pose).translation()).norm(),
            1e-6);
  std::string content = text();
  EXPECT_TRUE(contains(content, "parent: " + door));
  const std::string id = "- id: " + door + "\n";
  std::ofstream(path_) << content.replace(content.find(id), id.size(), id + "    parent: " + leaf + "\n");
  const auto loaded = callWithFile<LoadModels>("load_models", "");
  EXPECT_FALSE(loaded.first);
  EXPECT_TRUE(contains(loaded.second, "front " + door + " hangs on front " + leaf) && contains(loaded.second, "in a cycle"))
      << loaded.second;
  EXPECT_TRUE(predict(tracks_[1].id, q).success) << "what was known stays known";
}

TEST_F(ModelFile, ThatIsDamagedIsRefusedWithoutALossAndKeptBesideTheNextOne) {
  ASSERT_TRUE(play(200));
  ASSERT_TRUE(callWithFile<SaveModels>("save_models", "").first);
  std::string content = text();
  // A time that no message holds, which is noticed before anything changes.
  const size_t stamp = content.find("- [", content.find("observations:"));
  std::ofstream(path_) << content.replace(stamp, content.find(',', stamp) - stamp, "- [-1.5");
  const Recorder<KnownFrontArray> known("/cabinet/known_fronts");
  ASSERT_TRUE(spinUntil([&] { return !known.messages.empty(); }));
  const auto loaded = callWithFile<LoadModels>("load_models", "");
  EXPECT_FALSE(loaded.first);
  EXPECT_TRUE(contains(loaded.second, path_) && contains(loaded.second, "has the time -1.5")) << loaded.second;
  EXPECT_TRUE(predict(tracks_[0].id, 0).success) << "what was known stays known";
  observe(&tracks_[0], test::doorPose(1.4), 205);
  EXPECT_TRUE(publish(205)) << "and learning goes on";
  EXPECT_EQ(known.messages.size(), 1u) << "and the tracker heard nothing";
  const std::string damaged = text();
  const auto saved = callWithFile<SaveModels>("save_models", "");
  EXPECT_TRUE(saved.first && contains(saved.second, "2 fronts saved") && contains(saved.second, "is kept as")) << saved.second;
  std::ifstream kept(path_ + ".kept-1");
  EXPECT_EQ(std::string((std::istreambuf_iterator<char>(kept)), {}), damaged);
  restart();
  EXPECT_TRUE(predict(tracks_[0].id, 0).success);
}

TEST_F(ModelFile, ThatIsDamagedAtTheStartIsToldUntilTheNextOneIsSaved) {
  ASSERT_TRUE(play(250));
  unloadNodelet();
  const std::string half = text().substr(0, text().size() / 2);
  std::ofstream(path_) << half;
  loadNodelet();
  EXPECT_TRUE(spinUntil([&] { return reports_.statusHas("articulation", "kitchen.yaml"); }))
      << "before any track comes: " << reports_.status("articulation");
  ASSERT_TRUE(spinUntil([&] { return models_.connected() && output_.getNumSubscribers() > 0; }));
  for (core::Track& track : tracks_) track.observations.clear();
  ASSERT_TRUE(play(300)) << "works without";
  EXPECT_TRUE(spinUntil([&] { return reports_.statusHas("articulation", "kitchen.yaml"); })) << reports_.status("articulation");
  ASSERT_TRUE(callWithFile<SaveModels>("save_models", "").first);
  EXPECT_TRUE(spinUntil([&] { return !reports_.statusHas("articulation", "kitchen.yaml"); }))
      << "a trouble that is over is no longer told";
}

TEST_F(ModelFile, OfTheTimeWhenIdsBeganAtZeroIsRead) {
  ASSERT_TRUE(play(500));
  ASSERT_TRUE(callWithFile<SaveModels>("save_models", "").first);
  std::string content = text();
  const std::string id = "- id: " + std::to_string(tracks_[0].id);
  std::ofstream(path_) << content.replace(content.find(id), id.size(), "- id: 0");
  const auto loaded = callWithFile<LoadModels>("load_models", "");
  const std::uint32_t next = tracks_[1].id + 1;
  EXPECT_TRUE(loaded.first);
  EXPECT_TRUE(contains(loaded.second, "front 0 of the file is front " + std::to_string(next) + " now")) << loaded.second;
  EXPECT_TRUE(predict(next, 0.5).success);
  EXPECT_FALSE(predict(0, 0.5).success);
}

TEST_F(ModelFile, IsMergedByPlaceAndWithoutWhatWasReset) {
  ASSERT_TRUE(play(600));
  ASSERT_TRUE(callWithFile<SaveModels>("save_models", "").first);
  // A fresh run that knows only the drawer, by another number.
  unloadNodelet();
  nh_.setParam(kName + "/save_at_exit", false);
  nh_.setParam(kName + "/models_file", "");
  loadNodelet();
  ASSERT_TRUE(spinUntil([&] { return models_.connected() && output_.getNumSubscribers() > 0; }));
  const std::uint32_t door = tracks_[0].id, drawer = nextId();
  tracks_ = {tracks_[1]};
  tracks_[0].id = drawer;
  for (core::TrackedObservation& observation : tracks_[0].observations) observation.stamp += 1000;
  ASSERT_TRUE(publish(tracks_[0].observations.back().stamp));
  const auto merged = callWithFile<SaveModels>("save_models", path_);
  EXPECT_TRUE(merged.first && contains(merged.second, "2 fronts saved") && contains(merged.second, "1 of them as the file had"))
      << merged.second;
  EXPECT_TRUE(contains(text(), "- id: " + std::to_string(drawer) + "\n"));
  EXPECT_TRUE(contains(text(), "- id: " + std::to_string(door) + "\n"));
  std_srvs::Trigger reset;
  ASSERT_TRUE(ros::service::call("/cabinet/reset", reset));
  const auto after = callWithFile<SaveModels>("save_models", path_);
  EXPECT_TRUE(after.first && contains(after.second, "1 fronts saved")) << after.second;
  EXPECT_TRUE(contains(text(), "- id: " + std::to_string(door) + "\n")) << "this run never knew it";
  EXPECT_FALSE(contains(text(), "- id: " + std::to_string(drawer) + "\n")) << "this run forgot it";
}

TEST_F(ModelFile, CanBeChosenAndMustFitTheFrame) {
  EXPECT_TRUE(contains(callWithFile<LoadModels>("load_models", "/nowhere.yaml").second, "'/nowhere.yaml': cannot be opened"));
  ASSERT_TRUE(play(400));
  const std::string other = (folder_ / "other.yaml").string();
  const auto saved = callWithFile<SaveModels>("save_models", other);
  EXPECT_TRUE(saved.first && contains(saved.second, "2 fronts saved")) << saved.second;
  EXPECT_TRUE(contains(callWithFile<SaveModels>("save_models", "/nowhere/x.yaml").second, "cannot be written"));
  std::ifstream in(other);
  std::string content((std::istreambuf_iterator<char>(in)), {});
  content.replace(content.find("frame: map"), 10, "frame: odo");
  std::ofstream(other) << content;
  const auto loaded = callWithFile<LoadModels>("load_models", other);
  EXPECT_FALSE(loaded.first);
  EXPECT_TRUE(contains(loaded.second, "its poses are in the frame 'odo', tracks in 'map'")) << loaded.second;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "model_file_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
