// SPDX-License-Identifier: BSD-3-Clause
// What hangs on what, from the images of simulated scenes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace cabinet_articulation::core {
namespace {

struct Seen {
  std::vector<LearnedModel> models;
  GroundTruth truth;
};

/// The last models of a scene that the camera watches from its place, and the truth of the same frame.
Seen watch(const std::string& scene) {
  SimulationConfig config;
  config.scene = scene;
  SimulatedStereoCamera camera(config);
  Pipeline pipeline{PipelineConfig()};
  Seen seen;
  for (int i = 0; i < camera.frameCount(); ++i) {
    const StereoFrame frame = camera.frame(i);
    seen.models = pipeline.process(100 + frame.truth.time, frame.left, frame.right, camera.camera()).models;
    seen.truth = frame.truth;
  }
  return seen;
}

/// [rad] between two lines.
double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::asin(std::min(1.0, a.normalized().cross(b.normalized()).norm()));
}

/// The joint of that type whose axis, placed in the camera's frame, is nearest to the true one.
const LearnedModel* nearest(const Seen& seen, std::size_t joint) {
  const FrontTruth& truth = seen.truth.joints[joint];
  const LearnedModel* best = nullptr;
  double least = 0.1;  // [rad] or [m]: the joints of a scene are farther apart
  for (const LearnedModel& model : seen.models) {
    if (!isJoint(model) || model.type != truth.type || !hangsOnKnown(model, seen.models)) continue;
    const LearnedModel now = placed(model, seen.models);
    double distance = angle(now.axis, truth.axis);
    if (truth.type == JointType::kRotational)
      distance += (now.axis_point - truth.axis_point).cross(truth.axis).norm();
    else
      distance += std::abs((now.predict(now.q).translation() - truth.rectangle.center()).cross(truth.axis).norm());
    if (distance >= least) continue;
    least = distance;
    best = &model;
  }
  return best;
}

TEST(HangingScenes, SecondLeafOfTheFoldingDoorHangsOnTheFirst) {
  const Seen seen = watch("bifold");
  const LearnedModel *first = nearest(seen, 0), *second = nearest(seen, 1);
  ASSERT_TRUE(first != nullptr && second != nullptr);
  EXPECT_EQ(first->parent, 0U);
  EXPECT_EQ(second->parent, first->id);
  EXPECT_GT(second->parent_probability, 0.99);
  const LearnedModel now = placed(*second, seen.models);
  EXPECT_LT(angle(now.axis, seen.truth.joints[1].axis), 2 * M_PI / 180);
  EXPECT_LT((now.axis_point - seen.truth.joints[1].axis_point).cross(seen.truth.joints[1].axis).norm(), 0.015);
  EXPECT_NEAR(second->q_max - second->q_min, seen.truth.joints[1].q_max, 0.2);
}

TEST(HangingScenes, DrawersOfTheTrolleyHangOnItsFace) {
  const Seen seen = watch("trolley");
  const LearnedModel* face = nearest(seen, 0);
  ASSERT_NE(face, nullptr);
  EXPECT_EQ(face->parent, 0U);
  std::vector<const LearnedModel*> drawers;
  for (const LearnedModel& model : seen.models) {
    if (model.parent == 0) continue;
    EXPECT_EQ(model.parent, face->id);
    drawers.push_back(&model);
  }
  ASSERT_EQ(drawers.size(), 2U);
  for (const LearnedModel* drawer : drawers) {
    EXPECT_EQ(drawer->type, JointType::kPrismatic);
    EXPECT_LT(angle(placed(*drawer, seen.models).axis, seen.truth.joints[1].axis), 2 * M_PI / 180);
    EXPECT_GT(drawer->q_max - drawer->q_min, 0.8 * seen.truth.joints[1].q_max);
  }
}

TEST(HangingScenes, DoorAndDrawerOfTheCupboardHangOnTheWorld) {
  const Seen seen = watch("cupboard");
  EXPECT_GE(std::count_if(seen.models.begin(), seen.models.end(), isJoint), 2);
  for (const LearnedModel& model : seen.models) EXPECT_EQ(model.parent, 0U) << model.id;
}

}  // namespace
}  // namespace cabinet_articulation::core
