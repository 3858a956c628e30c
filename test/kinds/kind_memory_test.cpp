// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/kind_memory.h"

#include "kinds/taught_kinds.h"
#include "support/models.h"

namespace cabinet_articulation::core {
namespace {

using test::completed;
using test::doorOf;
using test::errorAt;
using test::expectSame;
using test::seen;
using test::teach;
using test::votes;

TEST(KindMemory, ChangesNothingOfTheFirstDoor) {
  KindMemory memory({});
  for (const double q : {0.0, 0.2, 0.4, 0.8, 1.5, 0.3}) {
    const Track track = seen(doorOf(0.5), 0, q);
    expectSame(completed({track}, &memory).at(0), learn(track));
  }
  EXPECT_EQ(votes(memory), 1u) << "one a front";
}

TEST(KindMemory, TellsABegunDoorItsWholeRange) {
  KindMemory memory({});
  teach(doorOf(0.5), 3, &memory);
  ASSERT_EQ(memory.kinds().size(), 1u);
  double alone = 0, told = 0;
  for (int i = 10; i < 15; ++i) {
    const Track begun = seen(doorOf(0.5), i, 0.3);
    const LearnedModel model = completed({begun}, &memory).at(0);
    EXPECT_EQ(model.type, JointType::kRotational);
    alone += errorAt(learn(begun), doorOf(0.5), i, 1.4, test::standing) / 5;
    told += errorAt(model, doorOf(0.5), i, 1.4, test::standing) / 5;
  }
  EXPECT_LT(told, 0.015);
  EXPECT_LT(told, alone / 2);
  EXPECT_EQ(votes(memory), 3u) << "who is told does not teach";
}

TEST(KindMemory, LeavesAFrontThatIsWellKnownToItsPoses) {
  KindMemory memory({});
  teach(doorOf(0.5), 3, &memory);
  const Track opened = seen(doorOf(0.55), 10, 1.5);
  expectSame(completed({opened}, &memory).at(0), learn(opened));
  EXPECT_EQ(votes(memory), 4u);
}

TEST(KindMemory, DoesNotTellAFrontWhatItTaught) {
  KindMemory memory({});
  teach(doorOf(0.5), 1, &memory);
  ASSERT_EQ(votes(memory), 1u);
  const Track begun = seen(doorOf(0.5), 0, 0.3);
  expectSame(completed({begun}, &memory).at(0), learn(begun));
}

TEST(KindMemory, FollowsTheFrontBetweenTwoFits) {
  KindMemory memory({});
  teach(doorOf(0.5), 3, &memory);
  const Track whole = seen(doorOf(0.5), 10, 0.4);
  for (int poses = 45; poses <= 60; ++poses) {
    Track track = whole;
    track.observations.resize(static_cast<std::size_t>(poses));
    const LearnedModel model = completed({track}, &memory).at(0);
    EXPECT_NEAR(model.q, 0.4 * (poses - 1) / 59, 0.04) << poses;
    EXPECT_GE(model.q_max, model.q);
    EXPECT_EQ(model.observations, poses);
  }
}

TEST(KindMemory, OfAClosingDoorIsThatOfAnOpeningOne) {
  KindMemory memory({});
  teach(doorOf(0.5), 2, &memory);
  SyntheticFront closing = doorOf(0.5);
  closing.q_start = 1.5;
  completed({seen(closing, 5, 0)}, &memory);
  ASSERT_EQ(memory.kinds().size(), 1u);
  EXPECT_EQ(memory.kinds()[0].size(), 3u);
  const LearnedModel model = completed({seen(closing, 10, 1.1)}, &memory).at(0);
  EXPECT_GE(model.q_max, -model.q_min) << "q grows as it was first seen to go";
  EXPECT_LT(errorAt(model, doorOf(0.5), 10, 0.1, test::standing), 0.02);
}

/// A track has any of the four descriptions of its rectangle.
Track describedAs(Track track, int k) {
  if (k % 2 != 0) std::swap(track.width, track.height);
  for (TrackedObservation& observation : track.observations) {
    observation.rectangle = describe(observation.rectangle, k);
    observation.measured = observation.rectangle;
  }
  return track;
}

TEST(KindMemory, ComparesFrontsWhicheverCornerTheirTracksChose) {
  KindMemory memory({});
  for (int k = 0; k < 4; ++k) completed({describedAs(seen(doorOf(0.5), k, 1.5), k)}, &memory);
  ASSERT_EQ(memory.kinds().size(), 1u);
  for (int k = 0; k < 4; ++k) {
    const Track begun = describedAs(seen(doorOf(0.5), 10 + k, 0.3), k);
    const LearnedModel model = completed({begun}, &memory).at(0);
    const Eigen::Isometry3d turn(Eigen::AngleAxisd(k * M_PI / 2, Eigen::Vector3d::UnitZ()));
    const Eigen::Isometry3d truth = test::standing(10 + k) * truePose(doorOf(0.5), 1.4) * turn;
    const Eigen::Isometry3d error = truth.inverse() * model.predict(model.configuration(truth));
    EXPECT_LT(error.translation().norm(), 0.02) << k;
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.1) << k;
    const LearnedModel closed = completed({describedAs(seen(doorOf(0.5), 20 + k, 0), k)}, &memory).at(0);
    EXPECT_FALSE(closed.observed);
    const Eigen::Isometry3d opened = test::standing(20 + k) * truePose(doorOf(0.5), 1.2) * turn;
    EXPECT_LT((closed.predict(1.2).translation() - opened.translation()).norm(), 0.04) << k;
  }
}

TEST(KindMemory, KeepsTheKindOfAFrontThatIsForgotten) {
  KindMemory memory({});
  teach(doorOf(0.5), 2, &memory);
  memory.forget(1);
  EXPECT_EQ(votes(memory), 2u);
  EXPECT_EQ(memory.votesBeside({2}).size(), 1u);
  completed({seen(doorOf(0.5), 0, 1.5)}, &memory);
  EXPECT_EQ(votes(memory), 3u) << "what returns is another front";
  memory.keepFronts({});
  EXPECT_EQ(memory.votesBeside({1, 2}).size(), 3u);
  memory.reset();
  EXPECT_TRUE(memory.kinds().empty());
}

TEST(KindMemory, TakesBackTheVoteOfAJointThatIsGivenUp) {
  KindMemory memory({});
  teach(doorOf(0.5), 2, &memory);
  LearnedModel given_up = learn(seen(doorOf(0.5), 0, 1.5));
  given_up.doubt = 1;
  given_up.moved = false;
  std::vector<LearnedModel> models{given_up};
  memory.complete({seen(doorOf(0.5), 0, 1.5)}, &models);
  EXPECT_EQ(votes(memory), 1u);
}

TEST(KindMemory, StartsFromWhatWasKnown) {
  KindMemory memory({});
  teach(doorOf(0.5), 3, &memory);
  const Track track = seen(doorOf(0.5), 0, 1.5);
  KindMemory next({});
  next.startFrom(memory.votesBeside({1}), {learn(track)});
  EXPECT_EQ(votes(next), 3u);
  ASSERT_EQ(next.kinds().size(), 1u);
  EXPECT_EQ(next.votesBeside({1}).size(), 2u) << "the file's front is front 1 again";
  EXPECT_LT(difference(next.kinds()[0].mean(), memory.kinds()[0].mean()).norm(), 1e-6);
}

/// Files may say so.
TEST(KindMemory, AJointThatContradictsItselfTeachesNothing) {
  LearnedModel door = ::cabinet_articulation::test::doorModel();
  door.probabilities = {0, 0, 1, 0, 0};
  door.support = 20;
  door.covariance = 1e-6 * Matrix6d::Identity();
  const auto votesFrom = [](const LearnedModel& joint) {
    KindMemory memory{LearningConfig()};
    memory.startFrom({}, {joint});
    return votes(memory);
  };
  EXPECT_EQ(votesFrom(door), 1U);
  LearnedModel on_its_axis = door, of_no_size = door, of_unknown_place = door;
  on_its_axis.axis_point = door.origin.translation() + 0.5 * door.axis;
  of_no_size.radius = 1e-320;
  of_unknown_place.covariance(0, 0) = 1e308;
  of_unknown_place.covariance(2, 2) = 1e308;
  of_unknown_place.covariance(0, 2) = of_unknown_place.covariance(2, 0) = -1e308;
  for (const LearnedModel& joint : {on_its_axis, of_no_size, of_unknown_place}) EXPECT_EQ(votesFrom(joint), 0U);
}

TEST(KindMemory, ExpectsAFrontAtRestToBeLikeOthersOfItsSize) {
  KindMemory memory({});
  teach(doorOf(0.5), 1, &memory);
  const Track unopened = seen(doorOf(0.5), 10, 0);
  EXPECT_TRUE(completed({unopened}, &memory).at(0).observed) << "one door alone says as much as what was never seen";
  teach(doorOf(0.5), 4, &memory);
  const LearnedModel model = completed({unopened}, &memory).at(0);
  EXPECT_FALSE(model.observed);
  EXPECT_FALSE(model.moved);
  EXPECT_EQ(model.type, JointType::kRotational);
  EXPECT_NEAR(probability(model, JointType::kRotational), 4.0 / 5, 0.02) << "four of five by the process, nearly";
  EXPECT_NEAR(probability(model, JointType::kRotational) + probability(model, JointType::kRigid), 1, 1e-9);
  EXPECT_EQ(model.q, 0);
  EXPECT_NEAR(model.q_max, 1.5, 0.05);
  EXPECT_NEAR(model.radius, 0.25, 0.01);
  EXPECT_LT(errorAt(model, doorOf(0.5), 10, 1.4, test::standing), 0.03);
  const double sigma = std::sqrt(model.covariance.bottomRightCorner<3, 3>().diagonal().maxCoeff());
  EXPECT_GT(sigma, 0.02);
  EXPECT_LT(sigma, 0.15);
}

TEST(KindMemory, ExpectsNothingOfAnotherSizeOrOfWhatIsHalfSeen) {
  KindMemory memory({});
  teach(doorOf(0.5), 4, &memory);
  EXPECT_TRUE(completed({seen(doorOf(0.9), 10, 0)}, &memory).at(0).observed);
  Track cut = seen(doorOf(0.5), 11, 0);
  for (TrackedObservation& observation : cut.observations) observation.edge_support[kEdgePlusX] = 0;
  EXPECT_TRUE(completed({cut}, &memory).at(0).observed);
}

TEST(KindMemory, HangsADoorOfAnotherWidthAtItsEdge) {
  KindMemory memory({});
  teach(doorOf(0.5), 4, &memory);
  const LearnedModel model = completed({seen(doorOf(0.55), 10, 0)}, &memory).at(0);
  ASSERT_FALSE(model.observed);
  EXPECT_NEAR(model.radius, 0.275, 0.006);
}

TEST(KindMemory, ThatMuchRestsMakesAnExpectationLessProbable) {
  KindMemory memory({});
  teach(doorOf(0.5), 4, &memory);
  std::vector<Track> room{seen(doorOf(0.5), 10, 0)};
  const double alone = probability(completed(room, &memory).at(0), JointType::kRotational);
  for (int i = 20; i < 60; ++i) room.push_back(seen(doorOf(1.2), i, 0));
  EXPECT_LT(probability(completed(room, &memory).at(0), JointType::kRotational), alone - 0.01);
}

TEST(KindMemory, CanBeTurnedOff) {
  LearningConfig config;
  config.kinds.kinds = false;
  KindMemory memory(config);
  teach(doorOf(0.5), 3, &memory);
  EXPECT_TRUE(memory.kinds().empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
