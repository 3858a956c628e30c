// SPDX-License-Identifier: BSD-3-Clause
#include "scores/prediction_error.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core::evaluation {
namespace {

/// A door that was seen opening from 0 to 0.4 rad.
LearnedModel door() {
  LearnedModel model;
  model.type = JointType::kRotational;
  model.axis = Eigen::Vector3d::UnitY();
  model.axis_point = Eigen::Vector3d(-0.2, 0, 1.5);
  model.origin.translation() = Eigen::Vector3d(0, 0, 1.5);
  model.q_max = 0.4;
  return model;
}

std::vector<ReferencePose> truth(const LearnedModel& model, double q_from, double q_to) {
  std::vector<ReferencePose> poses;
  for (int i = 0; i <= 20; ++i) {
    ReferencePose pose;
    const Rectangle front{model.predict(q_from + (q_to - q_from) * i / 20), 0.4, 0.6};
    pose.rectangle = describe(front, i % kDescriptions);
    poses.push_back(pose);
  }
  return poses;
}

TEST(PredictionError, TheTrueModelHasNone) {
  const PredictionError error = predictionError(door(), truth(door(), 0, 0.4));
  EXPECT_NEAR(error.position, 0, 1e-5);
  EXPECT_NEAR(error.orientation, 0, 1e-4);
}

TEST(PredictionError, ReachesOpeningsThatWereNotSeen) {
  EXPECT_NEAR(predictionError(door(), truth(door(), 1.2, 1.6)).position, 0, 1e-5);
}

TEST(PredictionError, IsTheDistanceFromTheModelsPath) {
  LearnedModel shifted = door();
  shifted.axis_point.y() += 0.007;
  shifted.origin.translation().y() += 0.007;
  EXPECT_NEAR(predictionError(shifted, truth(door(), 0, 0.4)).position, 0.007, 1e-6);
  LearnedModel smaller = door();
  smaller.origin.translation().x() -= 0.005;
  EXPECT_NEAR(predictionError(smaller, truth(door(), 0, 0.4)).position, 0.005, 1e-6);
}

TEST(PredictionError, MeasuresTheTurn) {
  LearnedModel turned = door();
  turned.origin.rotate(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(predictionError(turned, truth(door(), 0, 0.4)).orientation, 0.05, 1e-4);
}

TEST(PredictionError, WeighsPositionAgainstOrientation) {
  std::vector<ReferencePose> slipped = truth(door(), 0.2, 0.2);
  for (ReferencePose& pose : slipped) pose.rectangle.pose.pretranslate(0.2 * 0.05 * door().predict(0.2).linear().col(2));
  // 10 mm along the path at a radius of 0.2 m are 0.05 rad of q, or 1 sigma; turned by as much, the front is 0.5 sigma off.
  EXPECT_NEAR(predictionError(door(), slipped, false).orientation, 0.05, 1e-3);
  EXPECT_NEAR(predictionError(door(), slipped).orientation, 0.04, 1e-3);
}

TEST(PredictionError, ARigidModelStaysWhereItIs) {
  LearnedModel rigid;
  rigid.origin = door().origin;
  std::vector<ReferencePose> away(1);
  away[0].rectangle = {Eigen::Isometry3d(Eigen::Translation3d(0, 0, 1.6)), 0.4, 0.6};
  EXPECT_NEAR(predictionError(rigid, away).position, 0.1, 1e-9);
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
