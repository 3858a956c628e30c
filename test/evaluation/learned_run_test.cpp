// SPDX-License-Identifier: BSD-3-Clause
#include "scores/learned_run.h"

#include <gtest/gtest.h>

#include "cabinet_articulation/joints/hanging.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kStep = 0.1;

/// A door of 0.4 m about the vertical line through (-0.2, 0, 1.5), seen by a camera that moves.
LearnedModel door() {
  LearnedModel model;
  model.id = 7;
  model.type = JointType::kRotational;
  model.moved = true;
  model.axis = Eigen::Vector3d::UnitY();
  model.axis_point = Eigen::Vector3d(-0.2, 0.3, 1.5);
  model.origin.translation() = Eigen::Vector3d(0, 0, 1.5);
  model.q_max = 1;
  return model;
}

std::vector<Frame> doorFrames() {
  std::vector<Frame> frames;
  for (int i = 0; i <= 10; ++i) {
    Frame frame;
    frame.T_world_camera.translation().x() = 0.01 * i;
    Front still, front;
    still.name = "still";
    front.name = "door";
    front.type = JointType::kRotational;
    front.rectangle = {frame.T_world_camera.inverse() * door().predict(kStep * i), 0.4, 0.6};
    front.opened = kStep * i * 0.4;
    frame.fronts = {still, front};
    frames.push_back(frame);
  }
  return frames;
}

TEST(LearnedRun, TheTruthIsThatOfTheFrontOnWhichAModelLies) {
  std::vector<Frame> frames = doorFrames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].stamp = static_cast<double>(i);
    frames[i].fronts[0].rectangle = {frames[i].T_world_camera.inverse() * Eigen::Translation3d(1, 0, 1.5), 0.4, 0.6};
  }
  LearnedModel model = door();
  model.stamp = 10;
  model.q = 10 * kStep;
  EXPECT_EQ(trueType(model, {}, frames), JointType::kRotational);
  model.origin.translation().y() = 0.5;
  EXPECT_EQ(trueType(model, {}, frames), JointType::kRigid) << "no front is there";
  model.origin.translation() = Eigen::Vector3d(1.05, 0, 1.5);
  model.q = 0;
  EXPECT_EQ(trueType(model, {}, frames), JointType::kRigid) << "a front that stays";
}

TEST(LearnedRun, TheTruthOfAHangingFrontIsThatOfTheFrontOnWhichItLiesInTheWorld) {
  std::vector<Frame> frames = doorFrames();
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].stamp = static_cast<double>(i);
  LearnedModel parent;
  parent.id = 3;
  parent.type = JointType::kPrismatic;
  parent.moved = true;
  parent.axis = Eigen::Vector3d::UnitX();
  parent.origin.translation() = Eigen::Vector3d(2, 1, 0.5);
  parent.q = 0.3;
  const Eigen::Isometry3d T_parent_world = parent.predict(parent.q).inverse();
  LearnedModel hanging = transformed(door(), T_parent_world);
  hanging.parent = parent.id;
  hanging.stamp = 10;
  hanging.q = 10 * kStep;
  EXPECT_EQ(trueType(hanging, {parent, hanging}, frames), JointType::kRotational);
  LearnedRun run;
  run.add({parent, hanging});
  const std::optional<LearnedJoint> learned = run.find(findJoints(frames).at(0));
  ASSERT_TRUE(learned);
  EXPECT_EQ(learned->model.id, hanging.id);
  EXPECT_NEAR(learned->prediction.position, 0, 1e-6);
}

TEST(LearnedRun, TruePosesTellTheAxis) {
  const std::vector<TrueJoint> joints = findJoints(doorFrames());
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0].name, "door");
  EXPECT_NEAR(joints[0].axis.cross(door().axis).norm(), 0, 1e-9);
  EXPECT_NEAR((joints[0].axis_point - door().axis_point).cross(door().axis).norm(), 0, 1e-9);
}

TEST(LearnedRun, ADrawerTellsItsDirection) {
  std::vector<Frame> frames = doorFrames();
  for (Frame& frame : frames) {
    Front& front = frame.fronts[1];
    front.type = JointType::kPrismatic;
    front.rectangle.pose = frame.T_world_camera.inverse() * Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1.5 - front.opened));
  }
  EXPECT_NEAR(findJoints(frames).at(0).axis.z(), -1, 1e-9);
}

TEST(LearnedRun, MeasuresTheModelOfTheFront) {
  const TrueJoint joint = findJoints(doorFrames()).at(0);
  LearnedModel tilted = door(), elsewhere = door();
  const Eigen::AngleAxisd tilt(0.02, Eigen::Vector3d::UnitX());
  tilted.axis = tilt * tilted.axis;
  tilted.axis_point.x() -= 0.01;
  elsewhere.id = 8;
  elsewhere.origin.translation().y() += 0.5;
  LearnedRun run;
  for (std::size_t i = 0; i < joint.poses.size(); ++i) run.add({tilted, elsewhere});
  const std::optional<LearnedJoint> learned = run.find(joint);
  ASSERT_TRUE(learned);
  EXPECT_EQ(learned->model.id, 7U);
  EXPECT_NEAR(learned->axis_angle, 0.02, 1e-9);
  EXPECT_NEAR(learned->axis_distance, 0.01, 1e-3);
  EXPECT_GT(learned->prediction.position, 0.001);
  EXPECT_EQ(run.movers(), 2);
  LearnedRun wrong;
  wrong.add({elsewhere});
  EXPECT_FALSE(wrong.find(joint));
}

TEST(LearnedRun, IsRightFromWhereTheTypeStaysRight) {
  const TrueJoint joint = findJoints(doorFrames()).at(0);
  LearnedModel early = door();
  early.type = JointType::kPrismatic;
  LearnedModel unexplained = door();
  unexplained.explained = false;
  LearnedRun run;
  for (std::size_t i = 0; i < joint.poses.size(); ++i) run.add({i < 2 ? early : i == 4 ? unexplained : door()});
  ASSERT_TRUE(run.find(joint)->right_from);
  EXPECT_NEAR(*run.find(joint)->right_from, joint.poses[5].opened, 1e-12);
  run.add({early});
  EXPECT_FALSE(run.find(joint).value_or(LearnedJoint()).right_from);
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
