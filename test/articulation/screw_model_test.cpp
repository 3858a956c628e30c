// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/models/screw_model.h"

#include <gtest/gtest.h>

#include "articulation/models/model_registry.h"
#include "articulation/synthetic_tracks.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kTurn = 2 * M_PI;

LearnedModel screw(double pitch) {
  LearnedModel model = ScrewModel::example();
  model.pitch = pitch;
  return model;
}

Track screwTrack(double pitch, double turn, double noise, unsigned seed) {
  SyntheticFront front;
  front.q_end = turn;
  front.noise = noise;
  front.turn_noise = 3 * noise;
  front.seed = seed;
  const LearnedModel truth = screw(pitch);
  return syntheticTrack(front, [&](double q) { return truth.predict(q); });
}

bool isScrew(const LearnedModel& model) { return model.moved && model.type == ScrewModel::kTraits.type; }

TEST(ScrewModel, IsToldFromADoorWhereTheAdvanceIsThreeTimesTheNoise) {
  int right = 0, all = 0;
  for (const double noise : {0.0002, 0.001, 0.003})
    for (const double pitch : {0.002, 0.005, 0.01, 0.02, 0.05})
      for (const double degrees : {60., 120., 240., 360., 720.})
        for (unsigned seed = 1; seed <= 5; ++seed) {
          if (pitch * degrees / 360 < 3 * noise) continue;
          const LearnedModel model = learn(screwTrack(pitch / kTurn, degrees / 360 * kTurn, noise, seed));
          right += isScrew(model);
          ++all;
          if (isScrew(model)) {
            EXPECT_NEAR(model.pitch * kTurn, pitch, 0.2 * pitch + noise * 360 / degrees);
          }
        }
  EXPECT_GE(right, 0.97 * all);
}

TEST(ScrewModel, WithoutPitchIsADoor) {
  for (const double degrees : {60., 120., 240., 360., 720.})
    for (unsigned seed = 1; seed <= 5; ++seed)
      EXPECT_EQ(learn(screwTrack(0, degrees / 360 * kTurn, 0.001, seed)).type, JointType::kRotational) << degrees << " " << seed;
}

/// Drift of 4 mm, uneven along the axis, may look like a pitch; then it is as rare as screws are.
TEST(ScrewModel, DoorsAreNoScrews) {
  int screws = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    SyntheticFront front = door();
    front.seed = seed;
    front.drift = 0.002 * (seed % 3);
    const LearnedModel model = learn(syntheticTrack(front));
    screws += isScrew(model);
    EXPECT_LT(probability(model, ScrewModel::kTraits.type), 0.97) << seed;
  }
  EXPECT_LE(screws, 2);
}

TEST(ScrewModel, DrawersAreNoScrews) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    SyntheticFront front = drawer();
    front.seed = seed;
    front.drift = 0.002 * (seed % 3);
    EXPECT_EQ(learn(syntheticTrack(front)).type, JointType::kPrismatic) << seed;
  }
}

TEST(ScrewModel, PredictsBeyondATurn) {
  const double pitch = 0.02 / kTurn;
  const LearnedModel truth = screw(pitch), model = learn(screwTrack(pitch, 1.5 * kTurn, 0.001, 1));
  ASSERT_EQ(model.type, ScrewModel::kTraits.type);
  EXPECT_NEAR(model.q_max, 1.5 * kTurn, 0.03);
  for (const double q : {0.0, 3.0, 6.0, 9.0, 12.0})
    EXPECT_LT((model.predict(q).translation() - truth.predict(q).translation()).norm(), 0.004) << q;
}

TEST(ScrewModel, ALearnedJointTellsTurnsApart) {
  const LearnedModel model = screw(0.02 / kTurn);
  for (const double q : {0.0, 2.0, 4.0, 6.0, 8.0}) EXPECT_NEAR(model.configuration(model.predict(q)), q, 1e-9);
}

TEST(ScrewModel, DerivativeIsThatOfThePrediction) {
  constexpr double kStep = 1e-6;
  const LearnedModel model = screw(0.03);
  const double middle = (model.q_min + model.q_max) / 2, q = middle + 1;
  const Matrix6d J = ScrewModel::jacobianOfLearned(model, q);
  const Eigen::Isometry3d at_middle = model.predict(middle);
  for (int i = 0; i < 3; ++i) {
    // The axis turns about its point, the front stays where it is in the middle.
    const Eigen::AngleAxisd turn(kStep, Eigen::Vector3d::Unit(i));
    LearnedModel turned = model;
    turned.axis = turn * model.axis;
    turned.origin = at_middle;
    const Eigen::Vector3d arm = at_middle.translation() - model.axis_point;
    const Eigen::Vector3d moved = model.axis_point + Eigen::AngleAxisd(1, turned.axis) * arm + model.pitch * turned.axis;
    const Eigen::Vector3d change = (moved - model.predict(q).translation()) / kStep;
    EXPECT_LT((change - J.block<3, 1>(0, 3 + i)).norm(), 1e-4) << i;
  }
}

TEST(ScrewModel, HasNoUrdf) { EXPECT_EQ(modelEntry(ScrewModel::kTraits.type).urdf, UrdfJoint::kNone); }

}  // namespace
}  // namespace cabinet_articulation::core
