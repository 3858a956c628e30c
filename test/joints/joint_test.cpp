// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/joint.h"

#include <gmock/gmock.h>

#include <cmath>

#include "cabinet_articulation/joints/prediction.h"
#include "support/models.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::ThrowsSaying;
using testing::HasSubstr;
using testing::Property;

TEST(Joint, IsWhatMovedAlongAPathThatAModelDescribes) {
  EXPECT_TRUE(isJoint(test::doorModel()));
  EXPECT_TRUE(isJoint(test::drawerModel()));
  EXPECT_FALSE(isJoint(test::restingModel()));
  EXPECT_FALSE(isJoint(test::unexplainedModel()));
}

TEST(Joint, ProbabilityIsThatOfItsType) {
  LearnedModel door = test::doorModel();
  EXPECT_EQ(typeProbability(door), 0.97);
  door.probabilities.clear();
  EXPECT_EQ(typeProbability(door), 0) << "not given, as in a message from elsewhere";
}

TEST(Joint, IsNoneAnyMoreOnceAsMuchSpeaksAgainstItAsForIt) {
  LearnedModel door = test::doorModel();
  door.doubt = 0.99;
  EXPECT_TRUE(isJoint(door));
  EXPECT_FALSE(isGivenUp(door));
  door.doubt = 1;
  EXPECT_FALSE(isJoint(door));
  EXPECT_TRUE(isGivenUp(door) && wasJoint(door));
  EXPECT_THAT([&] { requireJoint(door); },
              ThrowsSaying<ModelError>(HasSubstr("front 3 was taken for a rotational joint, but as many observations")));
}

TEST(Joint, RefusalSaysWhichFrontAndWhy) {
  EXPECT_NO_THROW(requireJoint(test::doorModel()));
  EXPECT_THAT([] { requireJoint(test::restingModel()); },
              ThrowsSaying<ModelError>(HasSubstr("front 1 has not moved enough yet")));
  EXPECT_THAT([] { requireJoint(test::unexplainedModel()); },
              ThrowsSaying<ModelError>(HasSubstr("front 5 moved, but no joint type describes how")));
}

TEST(Joint, BaseOfADoorStandsOnItsHingeAndLooksAtTheFront) {
  const LearnedModel door = test::doorModel();
  const Eigen::Isometry3d base = jointBase(door);
  EXPECT_TRUE(base.translation().isApprox(door.axis_point, 1e-12));
  EXPECT_TRUE(base.linear().col(2).isApprox(door.axis, 1e-12));
  EXPECT_NEAR((base.inverse() * door.origin.translation()).x(), door.radius, 1e-9);
  EXPECT_NEAR(base.linear().determinant(), 1, 1e-12);
}

TEST(Joint, BaseOfADrawerIsTheClosedFront) {
  const LearnedModel drawer = test::drawerModel();
  const Eigen::Isometry3d base = jointBase(drawer);
  EXPECT_TRUE(base.translation().isApprox(drawer.origin.translation(), 1e-12));
  EXPECT_TRUE(base.linear().col(2).isApprox(drawer.axis, 1e-12));
}

TEST(Joint, BaseIsARotationEvenIfTheAxisGoesThroughTheCentre) {
  LearnedModel model = test::doorModel();
  model.axis_point = model.origin.translation();
  EXPECT_TRUE((jointBase(model).linear() * jointBase(model).linear().transpose()).isIdentity(1e-12));
}

TEST(Joint, OpeningCountsFromClosedToTheWidestSeen) {
  LearnedModel door = test::doorModel();
  EXPECT_TRUE(std::isnan(openingAt(door, 0.5)));
  EXPECT_THAT([&] { configurationAtOpening(door, 0.5); },
              ThrowsSaying<ModelError>(HasSubstr("it is not known where front 3 is closed")));
  door.closed_known = true;
  door.q_closed = -0.3;
  EXPECT_DOUBLE_EQ(openingAt(door, -0.3), 0);
  EXPECT_DOUBLE_EQ(openingAt(door, 0.45), 0.5);
  EXPECT_DOUBLE_EQ(openingAt(door, 2), 1);
  EXPECT_DOUBLE_EQ(configurationAtOpening(door, 0.5), 0.45);
  // First seen wide open: it opens towards q_min.
  door.q_min = -1.1;
  door.q_max = 0.02;
  door.q_closed = 0.1;
  EXPECT_DOUBLE_EQ(openingAt(door, -0.5), 0.5);
  EXPECT_DOUBLE_EQ(configurationAtOpening(door, 1), -1.1);
}

TEST(Joint, IsTheSameWhenItCountsFromWhereItIsClosed) {
  for (LearnedModel model : {test::doorModel(), test::drawerModel()}) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) model.covariance(i, j) = 1e-5 / (1 + i + j);
    for (const double closed : {model.q_min - 0.2, model.q_max + 0.2}) {
      model.closed_known = true;
      model.q_closed = closed;
      const LearnedModel counted = countedFromClosed(model);
      EXPECT_TRUE(counted.predict(0).isApprox(model.predict(closed), 1e-12));
      EXPECT_TRUE(counted.predict(counted.q).isApprox(model.predict(model.q), 1e-12));
      EXPECT_NEAR(counted.q_min, 0.2, 1e-12);
      EXPECT_NEAR(counted.q_max - counted.q_min, model.q_max - model.q_min, 1e-12);
      EXPECT_NEAR(openingAt(counted, counted.q), openingAt(model, model.q), 1e-12);
      const UncertainPose widest = predictWithCovariance(model, openEnd(model, closed));
      EXPECT_TRUE(predictWithCovariance(counted, counted.q_max).covariance.isApprox(widest.covariance, 1e-9)) << closed;
    }
  }
  LearnedModel known = test::doorModel();
  known.closed_known = true;
  known.q_closed = 0;
  EXPECT_EQ(allCountedFromClosed({known, test::drawerModel(), test::restingModel()}).size(), 1u);
}

TEST(Joint, WarnsOfOpeningsThatNobodyHasSeen) {
  const LearnedModel door = test::doorModel();
  EXPECT_EQ(outsideSeenRange(door, 0, 1.2), "");
  EXPECT_EQ(outsideSeenRange(door, 0, 1.5), "front 3 was seen from q = 0.000 to 1.200 rad; beyond that this is a guess");
  EXPECT_THAT(outsideSeenRange(test::drawerModel(), -0.1, 0), HasSubstr("0.300 m"));
}

}  // namespace
}  // namespace cabinet_articulation::core
