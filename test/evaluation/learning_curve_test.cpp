// SPDX-License-Identifier: BSD-3-Clause
#include "scores/learning_curve.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core::evaluation {
namespace {

/// A drawer that opens and closes again, 0.3 m in 150 poses, with a ripple of 1 mm so that it has some noise.
class Drawer : public TrackSource {
 public:
  Drawer() {
    facts_.name = "drawer";
    facts_.type = JointType::kPrismatic;
    for (int i = 0; i < 150; ++i) {
      const double opened = 0.3 * (1 - std::abs(i - 75) / 75.0);
      Rectangle front;
      front.pose.translation() = Eigen::Vector3d(0.001 * (i * 7 % 3 - 1), 0.1, 1.5 - opened);
      front.width = 0.4;
      front.height = 0.15;
      reference_.push_back({front, opened});
    }
  }

  const SourceFacts& facts() const override { return facts_; }
  const std::vector<ReferencePose>& reference() const override { return reference_; }

  void observe(const std::vector<int>& picked, const std::function<void(const SeenFront&)>& visit) const override {
    Track track;
    track.width = 0.4;
    track.height = 0.15;
    for (const int i : picked) {
      TrackedObservation observation;
      observation.stamp = i / 15.0;
      observation.rectangle = observation.measured = reference_[i].rectangle;
      track.observations.push_back(observation);
      visit({track});
    }
  }

 private:
  SourceFacts facts_;
  std::vector<ReferencePose> reference_;
};

TEST(LearningCurve, HasAPointForEveryRunAndCount) {
  const std::vector<CurvePoint> points = learningCurve(Drawer(), 3, 100, {10, 50, 100, 120});
  ASSERT_EQ(points.size(), 9U);  // no run sees more than 100 frames
  EXPECT_EQ(points[0].run, 0);
  EXPECT_EQ(points[0].observations, 10);
  EXPECT_EQ(points[8].run, 2);
  EXPECT_EQ(points[8].observations, 100);
  EXPECT_TRUE(isRight(points[8].model, Drawer().facts()));
  EXPECT_LT(points[8].error.position, 0.002);                     // the ripple
  EXPECT_NE(points[0].error.position, points[3].error.position);  // other frames in every run
  EXPECT_EQ(points[8].error.position, learningCurve(Drawer(), 3, 100, {10, 50, 100, 120})[8].error.position);
}

TEST(LearningCurve, AShortSourceIsSampledToo) { EXPECT_EQ(learningCurve(Drawer(), 1, 1000, {120, 121}).size(), 1U); }

TEST(LearningCurve, UnseenOpeningsArePredictedFromTheFirstOnesAlone) {
  const UnseenOpening unseen = predictUnseen(Drawer(), 0.5);
  ASSERT_TRUE(unseen.selected);
  EXPECT_EQ(unseen.selected->observations, 38);  // until it is half open for the first time
  EXPECT_NEAR(unseen.selected->q_max - unseen.selected->q_min, 0.15, 0.01);
  EXPECT_LT(unseen.selected_error->position, 0.005);
  EXPECT_LT(unseen.true_type_error->position, 0.005);
}

TEST(LearningCurve, AnUnexplainedMotionIsOther) {
  LearnedModel model;
  model.type = JointType::kRotational;
  SourceFacts other, door;
  other.explainable = false;
  door.type = JointType::kRotational;
  EXPECT_TRUE(isRight(model, door));
  EXPECT_FALSE(isRight(model, other));
  model.explained = false;
  EXPECT_FALSE(isRight(model, door));
  EXPECT_TRUE(isRight(model, other));
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
