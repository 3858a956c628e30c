// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/joint_kinds.h"

#include <gtest/gtest.h>

#include "kinds/fronts_elsewhere.h"

namespace cabinet_articulation::core {
namespace {

using test::doorOf;
using test::errorAt;
using test::moved;
using test::place;
using test::trackAt;

/// Doors of `width` at other places, opened widely.
void teach(const SyntheticFront& front, double q_end, int count, JointKinds* kinds) {
  for (int i = 0; i < count; ++i) {
    const Track track = trackAt(front, i, q_end);
    ASSERT_TRUE(kinds->add(learn(track), track, {}));
  }
}

TEST(JointKinds, PredictsTheWholeRangeOfADoorOfAKnownKindElsewhere) {
  JointKinds kinds({}, {});
  teach(doorOf(0.5), 1.5, 3, &kinds);
  ASSERT_EQ(kinds.kinds().size(), 1u);
  double alone = 0, with_kinds = 0;
  for (int i = 10; i < 15; ++i) {
    const Track begun = trackAt(doorOf(0.5), i, 0.35);
    const LearnedModel learned = learn(begun);
    const LearnedModel predicted = kinds.predict(learned, begun, {});
    EXPECT_EQ(predicted.type, JointType::kRotational);
    alone += errorAt(learned, doorOf(0.5), i, 1.4) / 5;
    with_kinds += errorAt(predicted, doorOf(0.5), i, 1.4) / 5;
  }
  EXPECT_LT(with_kinds, 0.015);  // radii of learned doors err by 1 %, directions by 1 degree
  EXPECT_LT(with_kinds, alone / 2);
}

TEST(JointKinds, LeavesADoorOfANewKindToItsPoses) {
  JointKinds kinds({}, {});
  teach(doorOf(0.5), 1.5, 3, &kinds);
  // It hangs at the opposite edge.
  const Eigen::Isometry3d half_turn(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ()));
  Track begun = trackAt(doorOf(0.5), 10, 0.6);
  for (TrackedObservation& observation : begun.observations) observation.rectangle.pose = observation.rectangle.pose * half_turn;
  const LearnedModel learned = learn(begun);
  const LearnedModel predicted = kinds.predict(learned, begun, {});
  EXPECT_EQ(predicted.radius, learned.radius);
  EXPECT_EQ(predicted.probabilities, learned.probabilities);
  const Track opened = trackAt(drawer(), 11, 0.3);
  ASSERT_TRUE(kinds.add(learn(opened), opened, {}));
  EXPECT_EQ(kinds.kinds().size(), 2u);
}

TEST(JointKinds, IsOutweighedByPosesOfAnotherDoor) {
  JointKinds kinds({}, {});
  teach(doorOf(0.5), 1.5, 3, &kinds);
  const Track opened = trackAt(doorOf(0.8), 10, 1.2);
  const LearnedModel predicted = kinds.predict(learn(opened), opened, {});
  EXPECT_LT(errorAt(predicted, doorOf(0.8), 10, 1.4), 0.01);
  ASSERT_TRUE(kinds.add(learn(opened), opened, {}));
  EXPECT_EQ(kinds.kinds().size(), 2u);
}

TEST(JointKinds, TellsADoorFromADrawerByTheirKinds) {
  JointKinds kinds({}, {});
  teach(doorOf(0.5), 1.5, 2, &kinds);
  teach(drawer(), 0.4, 2, &kinds);
  EXPECT_EQ(kinds.kinds().size(), 2u);
  const Track door_begun = trackAt(doorOf(0.5), 10, 0.4), drawer_begun = trackAt(drawer(), 11, 0.12);
  EXPECT_GT(probability(kinds.predict(learn(door_begun), door_begun, {}), JointType::kRotational), 0.95);
  EXPECT_GT(probability(kinds.predict(learn(drawer_begun), drawer_begun, {}), JointType::kPrismatic), 0.95);
}

TEST(JointKinds, PositionsAloneKeepTheDirectionsOfTheirFrame) {
  ArticulationConfig config;
  config.use_orientation = false;
  JointKinds kinds({}, {});
  const auto begin = [](int i, double q_end) {
    Track track = moved(trackAt(doorOf(0.5), i, q_end), place(i).inverse());
    for (TrackedObservation& observation : track.observations) observation.rectangle.pose.linear().setIdentity();
    return moved(track, Eigen::Isometry3d(Eigen::Translation3d(i, 0, 0)));
  };
  for (int i = 0; i < 3; ++i) {
    const Track track = begin(i, 1.5);
    ASSERT_TRUE(kinds.add(learn(track, config), track, config));
  }
  EXPECT_EQ(kinds.kinds().size(), 1u);
  const Track begun = begin(10, 0.4);
  const LearnedModel predicted = kinds.predict(learn(begun, config), begun, config);
  EXPECT_NEAR(predicted.radius, 0.25, 0.01);
}

TEST(JointKinds, TakesNothingFromAFrontAtRest) {
  JointKinds kinds({}, {});
  teach(doorOf(0.5), 1.5, 3, &kinds);
  const Track track = trackAt(still(), 10, 0);
  const LearnedModel learned = learn(track);
  EXPECT_FALSE(kinds.add(learned, track, {}));
  const LearnedModel predicted = kinds.predict(learned, track, {});
  EXPECT_EQ(predicted.type, JointType::kRigid);
  EXPECT_FALSE(predicted.moved);
}

}  // namespace
}  // namespace cabinet_articulation::core
