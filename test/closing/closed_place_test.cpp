// SPDX-License-Identifier: BSD-3-Clause
#include "closing/closed_place.h"

#include <gtest/gtest.h>

#include "cabinet_articulation/joints/joint.h"
#include "support/models.h"

namespace cabinet_articulation::core {
namespace {

TEST(ClosedPlace, IsWhereTheFrontLiesInThePlane) {
  for (const LearnedModel& joint : {test::doorModel(), test::drawerModel()}) {
    for (const double q : {-0.2, 0.0, 0.15}) {
      EXPECT_NEAR(configurationInPlaneOf(frontAt(joint, q), joint), q, 1e-9);
      // The plane of the front at another q, as the front at q sees it.
      const Eigen::Isometry3d T = joint.predict(q).inverse() * joint.predict(q + 0.05);
      SurfacePlane plane;
      const Eigen::Vector3d n = T.linear().col(2);
      plane.c << n.dot(T.translation()) / n.z(), -n.x() / n.z(), -n.y() / n.z();
      EXPECT_NEAR(correctionTo(plane, joint, q).q, 0.05, 1e-9);
    }
  }
}

TEST(ClosedPlace, OfASlidingDoorIsNotTold) {
  LearnedModel sliding = test::drawerModel();
  EXPECT_TRUE(leavesItsPlane(sliding));
  sliding.axis = sliding.origin.linear().col(0);
  EXPECT_FALSE(leavesItsPlane(sliding)) << "it lies in the same plane wherever it is";
  LearnedModel turning = test::doorModel();
  EXPECT_TRUE(leavesItsPlane(turning));
  turning.axis = turning.origin.linear().col(2);
  EXPECT_FALSE(leavesItsPlane(turning)) << "as a knob";
  EXPECT_FALSE(leavesItsPlane(test::garageModel())) << "no single joint";
}

TEST(ClosedPlace, NothingOpensIntoItsCabinetOrBeyondItsClosedPosition) {
  LearnedModel drawer = test::drawerModel();
  drawer.axis = drawer.origin.linear().col(2);
  drawer.q_min = 0;
  drawer.q_max = 0.3;
  EXPECT_TRUE(opensOutwardsFrom(drawer, 0));
  EXPECT_TRUE(opensOutwardsFrom(drawer, -0.1)) << "first seen open";
  EXPECT_TRUE(opensOutwardsFrom(drawer, 0.01)) << "noise";
  EXPECT_FALSE(opensOutwardsFrom(drawer, 0.1)) << "seen farther in";
  EXPECT_FALSE(opensOutwardsFrom(drawer, 0.3)) << "goes inwards from there";
}

}  // namespace
}  // namespace cabinet_articulation::core
