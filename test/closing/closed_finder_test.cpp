// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "geometry/degrees.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kRate = 8;  // [Hz]

/// One front in a kitchen that opens, waits and closes, seen by a depth camera.
class Closing : public testing::Test {
 protected:
  /// Shows the frames in which the front's opening, relative to the widest, is in these bounds. Those of its rest at first or at
  /// last are repeated, as if it had been left there.
  struct Shown {
    double from = 0, to = 1;
    bool opening = true, closing = true;
  };

  void show(const std::string& scene, const Shown& shown) {
    SimulationConfig config;
    config.scene = scene;
    config.rate = kRate;
    SimulatedStereoCamera simulation(config);
    const auto openingOf = [&](int i) { return simulation.truth(i).joints[0].q / simulation.truth(i).joints[0].q_max; };
    int widest = 0;
    for (int i = 0; i < simulation.frameCount(); ++i)
      if (openingOf(i) > openingOf(widest)) widest = i;
    for (int i = 0; i < simulation.frameCount(); ++i) {
      const bool phase = i <= widest ? shown.opening : shown.closing;
      if (!phase || openingOf(i) < shown.from || openingOf(i) > shown.to) continue;
      const bool first = frames_ == 0;
      show(simulation, i);
      for (int k = 0; first && k < kRest; ++k) show(simulation, i);
      last_ = i;
    }
    for (int k = 0; k < kRest; ++k) show(simulation, last_);
    truth_ = simulation.truth(last_).joints[0];
  }

  void show(SimulatedStereoCamera& simulation, int i) {
    const StereoFrame frame = simulation.frame(i);
    show(frameFromDepth(frame.depth, simulation.camera()));
  }

  /// Somebody stands in front of the camera, or it sees nothing.
  void block(double distance) {
    DepthFrame depth = result_.frame;
    depth.disparity = distance > 0 ? depth.camera.fx * depth.camera.baseline / distance : 0.0;
    for (int i = 0; i < kRest; ++i) show(depth);
  }

  /// The front is gone, and nothing of what was behind it has depth.
  void emptyPlaceOf(const LearnedModel& joint) {
    DepthFrame depth = result_.frame;
    depth.disparity = depth.disparity.clone();
    const Rectangle front = frontAt(joint, joint.q_closed);
    for (int v = 0; v < depth.disparity.rows; ++v)
      for (int u = 0; u < depth.disparity.cols; ++u) {
        const Eigen::Vector3d ray((u - depth.camera.cx) / depth.camera.fx, (v - depth.camera.cy) / depth.camera.fy, 1);
        const double along = front.normal().dot(front.center()) / front.normal().dot(ray);
        const Eigen::Vector3d at = front.pose.inverse() * (along * ray);
        if (std::abs(at.x()) < front.width / 2 && std::abs(at.y()) < front.height / 2) depth.disparity(v, u) = 0;
      }
    for (int i = 0; i < kRest; ++i) show(depth);
  }

  void show(const DepthFrame& depth) {
    result_ = pipeline_.process(100 + frames_++ / kRate, depth);
    for (const LearnedModel& model : result_.models) {
      if (!model.moved) continue;
      if (!joint_) first_q_of_closed_ = model.q_closed;
      joint_ = model;
    }
  }

  /// As the newest frame shows it.
  void expectShut() const {
    ASSERT_TRUE(joint_ && joint_->closed_known);
    EXPECT_EQ(joint_->q, joint_->q_closed);
    EXPECT_EQ(joint_->opening, 0);
    EXPECT_NEAR(joint_->stamp, result_.view.stamp, 1e-9);
    EXPECT_LE(joint_->q_min, joint_->q);
    EXPECT_GE(joint_->q_max, joint_->q);
  }

  /// q counted from the closed position is the truth's.
  void expectClosed(double tolerance) const {
    ASSERT_TRUE(joint_);
    ASSERT_TRUE(joint_->closed_known);
    EXPECT_GE(joint_->opening, 0);
    EXPECT_LE(joint_->opening, 1);
    const Rectangle closed{joint_->predict(joint_->q_closed), joint_->width, joint_->height};
    Rectangle open = truth_.rectangle;
    // Back by the truth's own joint.
    Eigen::Isometry3d T_closed_open = Eigen::Isometry3d::Identity();
    if (truth_.type == JointType::kRotational)
      T_closed_open = Eigen::Translation3d(truth_.axis_point) * Eigen::AngleAxisd(-truth_.q, truth_.axis) *
                      Eigen::Translation3d(-truth_.axis_point);
    else
      T_closed_open.translation() = -truth_.q * truth_.axis;
    open.pose = T_closed_open * open.pose;
    if (truth_.type == JointType::kRotational)
      EXPECT_LT(std::acos(std::min(1.0, closed.normal().dot(open.normal()))), tolerance);
    else
      EXPECT_LT(std::abs(open.normal().dot(closed.center() - open.center())), tolerance);
  }

  static constexpr int kRest = 4;  // frames
  Pipeline pipeline_{{}};
  PipelineResult result_;
  std::optional<LearnedModel> joint_;
  FrontTruth truth_;
  double first_q_of_closed_ = 0;
  int frames_ = 0, last_ = 0;
};

constexpr double kAngle = 0.5 * kDegree, kLength = 0.004;  // what the closed position is wanted for

TEST_F(Closing, OfADoorThatStartsClosedIsKnown) {
  show("door", {0, 1, true, false});
  expectClosed(kAngle);
  EXPECT_NEAR(joint_->opening, 1, 0.02) << "left wide open";
}

TEST_F(Closing, OfADrawerThatStartsClosedIsKnown) {
  show("drawer", {0, 1, true, false});
  expectClosed(kLength);
  EXPECT_NEAR(joint_->opening, 1, 0.02);
}

TEST_F(Closing, OfADoorThatStartsHalfOpenIsKnownOnceItIsClosed) {
  show("door", {0, 1, false, true});
  expectClosed(kAngle);
}

TEST_F(Closing, OfADrawerThatStartsHalfOpenIsKnownOnceItIsClosed) {
  show("drawer", {0, 1, false, true});
  expectClosed(kLength);
}

TEST_F(Closing, OfADoorIsWhereItIsOnceItIsShut) {
  show("door", {});
  expectShut();
}

TEST_F(Closing, OfADrawerIsWhereItIsOnceItIsShut) {
  show("drawer", {});
  expectShut();
}

TEST_F(Closing, OfADoorThatIsSeenOnlyToShutIsWhereItIs) {
  show("door", {0, 1, false, true});
  expectShut();
}

TEST_F(Closing, LeavesADoorAjarThatIsLeftSo) {
  show("door", {0, 1, true, false});
  show("door", {0.05, 1, false, true});  // 4 degrees
  ASSERT_TRUE(joint_ && joint_->closed_known);
  EXPECT_GT(joint_->opening, 0.03);
}

TEST_F(Closing, LeavesADoorWhereItWasSeenWhileItIsHidden) {
  show("door", {0, 1, true, false});
  ASSERT_TRUE(joint_ && joint_->closed_known);
  const LearnedModel seen = *joint_;
  for (const double distance : {0.5, 0.0}) {
    block(distance);
    ASSERT_FALSE(result_.models.empty()) << distance;
    EXPECT_NEAR(joint_->q, seen.q, 0.02) << distance;
    EXPECT_LE(joint_->stamp, seen.stamp) << distance;
  }
}

TEST_F(Closing, OfAShutDoorStaysWhileItIsHidden) {
  show("door", {});
  const double shut_at = result_.view.stamp;
  block(0.5);
  ASSERT_FALSE(result_.models.empty());
  EXPECT_EQ(joint_->opening, 0);
  EXPECT_NEAR(joint_->stamp, shut_at, 1e-9);
}

TEST_F(Closing, OfAShutDoorIsLeftWhenItOpensAgain) {
  show("door", {});
  expectShut();
  show("door", {0, 0.5, true, false});
  EXPECT_NEAR(joint_->opening, 0.5, 0.1);
}

TEST_F(Closing, OfAShutDoorIsLeftWhenItIsGoneAndItsCabinetHasNoDepth) {
  show("door", {});
  expectShut();
  emptyPlaceOf(*joint_);
  ASSERT_TRUE(joint_->closed_known);
  EXPECT_GT(joint_->opening, 0.01) << "as it was detected last";
  EXPECT_LT(joint_->stamp, result_.view.stamp - 0.1);
}

TEST_F(Closing, OfADoorThatWasAjarAllTheTimeIsUnknown) {
  show("door", {0.1, 1, true, true});
  ASSERT_TRUE(joint_);
  EXPECT_FALSE(joint_->closed_known);
  EXPECT_TRUE(std::isnan(joint_->q_closed));
  EXPECT_TRUE(std::isnan(joint_->opening));
}

TEST_F(Closing, OfADrawerThatWasAjarAllTheTimeIsUnknown) {
  show("drawer", {0.1, 1, true, true});
  ASSERT_TRUE(joint_);
  EXPECT_FALSE(joint_->closed_known);
}

TEST_F(Closing, IsRememberedAndFollowsTheJoint) {
  show("door", {0, 1, true, false});
  ASSERT_TRUE(joint_ && joint_->closed_known);
  ClosedFinder finder;
  finder.remember({*joint_});
  // The same joint, counted from another place, as after it was learned anew.
  LearnedModel anew = *joint_;
  constexpr double kShift = 0.3;
  anew.origin = joint_->predict(kShift);
  for (double* q : {&anew.q, &anew.q_min, &anew.q_max}) *q -= kShift;
  anew.closed_known = false;
  std::vector<LearnedModel> models{anew};
  finder.complete(&models);
  ASSERT_TRUE(models[0].closed_known);
  EXPECT_NEAR(models[0].q_closed, joint_->q_closed - kShift, 1e-6);
  finder.forget(joint_->id);
  finder.complete(&models);
  EXPECT_FALSE(models[0].closed_known);
}

TEST_F(Closing, IsGivenUpWhenTheFrontIsSeenFartherIn) {
  show("drawer", {0, 1, true, false});
  ASSERT_TRUE(joint_ && joint_->closed_known);
  ClosedFinder finder;
  finder.remember({*joint_});
  LearnedModel farther = *joint_;
  (openEnd(farther, farther.q_closed) == farther.q_max ? farther.q_min : farther.q_max) =
      farther.q_closed + (openEnd(farther, farther.q_closed) == farther.q_max ? -0.1 : 0.1);
  std::vector<LearnedModel> models{farther};
  finder.complete(&models);
  EXPECT_FALSE(models[0].closed_known);
}

}  // namespace
}  // namespace cabinet_articulation::core
