// SPDX-License-Identifier: BSD-3-Clause
// Kinds of joints that outlive their fronts and the nodelet that learned them.
#include <cabinet_articulation/Forget.h>
#include <cabinet_articulation/Kinds.h>
#include <cabinet_articulation/SaveModels.h>

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/model_file_fixture.h"

namespace cabinet_articulation {
namespace {

class KindsInAFile : public test::ModelFile {
 protected:
  /// Another unit beside the last one: its door and drawer open, as far as `share` says; its wall rests.
  ArticulationModelArrayConstPtr playUnit(int unit, double start, double share = 1) {
    const Eigen::Isometry3d place(Eigen::Translation3d(1.5 * unit, 0, 0));
    for (core::Track& track : tracks_) track.id = nextId();
    for (core::Track& track : tracks_) track.observations.clear();
    ArticulationModelArrayConstPtr models;
    for (int i = 0; i < test::kFrames; ++i) {
      const double opening = share * std::max(0, i - test::kAtRest) / (test::kFrames - 1 - test::kAtRest);
      observe(&tracks_[0], place * test::doorPose(1.4 * opening), start + i / 15.0);
      observe(&tracks_[1], place * test::drawerPose(0.3 * opening), start + i / 15.0);
      observe(&tracks_[2], place * test::wallPose(0), start + i / 15.0);
      models = publish(start + i / 15.0);
    }
    return models;
  }

  static Kinds::Response kinds(bool clear = false) {
    Kinds kinds;
    kinds.request.clear = clear;
    EXPECT_TRUE(ros::service::call("/cabinet/kinds", kinds));
    EXPECT_TRUE(kinds.response.success) << kinds.response.message;
    return kinds.response;
  }

  static std::uint32_t doorsKnown() { return ofType(ArticulationModel::ROTATIONAL, kinds()).joints; }

  static const Kind& ofType(std::uint8_t type, const Kinds::Response& answer) {
    static const Kind none;
    for (const Kind& kind : answer.kinds)
      if (kind.type == type) return kind;
    return none;
  }
};

TEST_F(KindsInAFile, AreListed) {
  ASSERT_TRUE(playUnit(0, 700));
  EXPECT_EQ(kinds().kinds.size(), 2u);
  ASSERT_TRUE(playUnit(1, 720));
  const ArticulationModelArrayConstPtr models = playUnit(2, 740);
  ASSERT_TRUE(models);
  const Kinds::Response answer = kinds();
  ASSERT_EQ(answer.kinds.size(), 2u) << answer.message;
  const Kind& doors = ofType(ArticulationModel::ROTATIONAL, answer);
  EXPECT_EQ(doors.joints, 3u);
  EXPECT_EQ(doors.fronts.size(), 3u);
  EXPECT_EQ(doors.hinge, "left") << "as seen from before it";
  EXPECT_NEAR(doors.radius, 0.2, 0.005);
  EXPECT_NEAR(doors.radius_to_width, 0.5, 0.01);
  EXPECT_NEAR(doors.range, 1.4, 0.02);
  EXPECT_NEAR(doors.width, 0.4, 0.01);
  EXPECT_NEAR(doors.height, 0.6, 0.01);
  EXPECT_NEAR(std::abs(doors.axis.y), 1, 0.01);
  EXPECT_NEAR(doors.share, 0.5, 1e-9);
  EXPECT_NEAR(ofType(ArticulationModel::PRISMATIC, answer).axis.z, 1, 0.01) << "outwards";

  // The wall is as large as the doors.
  ASSERT_EQ(models->models.size(), 3u);
  const ArticulationModel& wall = models->models[2];
  EXPECT_FALSE(wall.moved);
  EXPECT_FALSE(wall.observed);
  EXPECT_EQ(wall.type, ArticulationModel::ROTATIONAL);
  EXPECT_GT(wall.probabilities[ArticulationModel::ROTATIONAL], 0.5);
  EXPECT_LT(wall.probabilities[ArticulationModel::ROTATIONAL], 0.8) << "three of four";
  EXPECT_FALSE(predict(wall.id, 0.1).success) << "it is no joint";
}

TEST_F(KindsInAFile, OutliveTheirFrontsAndARestart) {
  for (int unit = 0; unit < 3; ++unit) ASSERT_TRUE(playUnit(unit, 800 + 20 * unit));
  ASSERT_TRUE(callWithFile<SaveModels>("save_models", "").first);
  EXPECT_FALSE(contains(text(), "kinds:")) << "fronts teach theirs";
  const double radius = ofType(ArticulationModel::ROTATIONAL, kinds()).radius;
  const std::uint32_t door = tracks_[0].id;
  Forget forget;
  forget.request.id = door;
  ASSERT_TRUE(ros::service::call("/cabinet/forget", forget) && forget.response.success);
  EXPECT_TRUE(contains(text(), "kinds:")) << "at once, whatever happens before the next save";
  EXPECT_EQ(doorsKnown(), 3u) << "such doors exist";
  EXPECT_EQ(ofType(ArticulationModel::ROTATIONAL, kinds()).fronts.size(), 2u);
  restart();
  const Kinds::Response after = kinds();
  ASSERT_EQ(after.kinds.size(), 2u) << after.message;
  const Kind& doors = ofType(ArticulationModel::ROTATIONAL, after);
  EXPECT_EQ(doors.joints, 3u);
  EXPECT_EQ(doors.fronts.size(), 2u);
  EXPECT_NEAR(doors.radius, radius, 1e-4);
  EXPECT_FALSE(predict(door, 0.1).success);
}

TEST_F(KindsInAFile, AreTaughtNothingByWhatTheyTold) {
  for (int unit = 0; unit < 3; ++unit) ASSERT_TRUE(playUnit(unit, 900 + 20 * unit));
  ASSERT_EQ(doorsKnown(), 3u);
  const ArticulationModelArrayConstPtr models = playUnit(3, 960, 0.1);
  ASSERT_TRUE(models);
  const ArticulationModel& begun = models->models.at(0);
  ASSERT_TRUE(begun.moved);
  const auto is_own = [](const Param& param) { return param.name.rfind("rot_", 0) == 0; };
  ASSERT_TRUE(std::none_of(begun.params.begin(), begun.params.end(), is_own)) << "it is told";
  EXPECT_EQ(doorsKnown(), 3u);
  const Predict::Response before = predict(begun.id, 1);
  ASSERT_TRUE(before.success) << before.message;
  restart();
  EXPECT_EQ(doorsKnown(), 3u) << "who is told does not teach, after a restart either";
  const Predict::Response after = predict(begun.id, 1);
  ASSERT_TRUE(after.success) << after.message;
  EXPECT_LT((fromMessage(after.poses.at(0).pose).translation() - fromMessage(before.poses.at(0).pose).translation()).norm(), 1e-4)
      << "and is told the same";
}

TEST_F(KindsInAFile, ThatWereClearedStayAwayFromEachFile) {
  ASSERT_TRUE(playUnit(0, 1000));
  Forget forget;
  forget.request.id = tracks_[0].id;
  ASSERT_TRUE(ros::service::call("/cabinet/forget", forget) && forget.response.success);
  ASSERT_TRUE(callWithFile<SaveModels>("save_models", "").first);
  ASSERT_TRUE(contains(text(), "kinds:"));
  EXPECT_TRUE(kinds(true).kinds.empty());
  ASSERT_TRUE(callWithFile<SaveModels>("save_models", (folder_ / "backup.yaml").string()).first);
  unloadNodelet();
  EXPECT_FALSE(contains(text(), "kinds:")) << "saved at exit, after another file";
  loadNodelet();
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "kinds_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
