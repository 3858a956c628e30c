// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/known_fronts.h"

#include <gmock/gmock.h>

#include "support/models.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::ThrowsSaying;
using testing::HasSubstr;

Track trackOf(const LearnedModel& model) {
  Track track;
  track.id = model.id;
  track.observations.resize(2);
  return track;
}

void see(KnownFronts* known, const std::vector<LearnedModel>& models) {
  std::vector<TrackUpdate> tracks;
  for (const LearnedModel& model : models) tracks.push_back({trackOf(model)});
  known->follow(std::move(tracks));
  known->update(models);
}

TEST(KnownFronts, SaysWhichFrontsThereAre) {
  KnownFronts known;
  EXPECT_THAT([&] { known.at(7); }, ThrowsSaying<ModelError>(HasSubstr("no front 7; none was seen yet")));
  see(&known, {test::restingModel(), test::doorModel()});
  EXPECT_THAT([&] { known.at(7); }, ThrowsSaying<ModelError>("there is no front 7; the fronts known are 1, 3"));
  EXPECT_EQ(known.at(3).type, JointType::kRotational);
}

TEST(KnownFronts, RemembersJointsThatAreOutOfViewAndForgetsTheRest) {
  KnownFronts known;
  see(&known, {test::restingModel(), test::doorModel()});
  see(&known, {test::drawerModel()});
  EXPECT_EQ(known.at(3).radius, test::doorModel().radius);
  EXPECT_THROW(known.at(1), ModelError);
  const std::vector<KnownFront> joints = known.joints();
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints[0].model.id, 3u);
  EXPECT_EQ(joints[0].track.observations.size(), 2u);
  EXPECT_EQ(joints[1].model.id, 4u);
}

TEST(KnownFronts, AnArmThatPassedIsNotRemembered) {
  KnownFronts known;
  LearnedModel arm = test::doorModel();
  arm.observations = 4;
  see(&known, {arm});
  EXPECT_TRUE(isJoint(known.at(3))) << "asked for while it is there, it is what it seems";
  EXPECT_TRUE(known.joints().empty());
  see(&known, {});
  EXPECT_THROW(known.at(3), ModelError);
}

TEST(KnownFronts, AFrontThatCameBackKeepsWhatWasKnownUntilItMovesAgain) {
  KnownFronts known;
  known.replace({{test::doorModel(), trackOf(test::doorModel())}});
  LearnedModel back = test::restingModel();
  back.id = 3;
  see(&known, {back});
  EXPECT_TRUE(isJoint(known.at(3)));
  LearnedModel moved = test::doorModel();
  moved.q_max = 1.5;
  see(&known, {moved});
  EXPECT_EQ(known.at(3).q_max, 1.5);
  EXPECT_EQ(known.joints().size(), 1u);
}

TEST(KnownFronts, AJointStaysKnownWhileItsModelTellsLess) {
  KnownFronts known;
  see(&known, {test::doorModel()});
  LearnedModel less = test::restingModel();
  less.id = 3;
  LearnedModel unexplained = test::unexplainedModel();
  unexplained.id = 3;
  for (const LearnedModel& now : {less, unexplained}) {
    see(&known, {now});
    EXPECT_TRUE(isJoint(known.at(3)));
    EXPECT_EQ(known.joints().size(), 1u) << "and would be saved";
  }
}

TEST(KnownFronts, AJointThatIsGivenUpIsKeptWithItsDoubtButAnswersNothing) {
  KnownFronts known;
  see(&known, {test::doorModel()});
  LearnedModel given_up = test::restingModel();
  given_up.id = 3;
  given_up.doubt = 1;
  see(&known, {given_up});
  EXPECT_THAT([&] { requireJoint(known.at(3)); }, ThrowsSaying<ModelError>(HasSubstr("was taken for a rotational joint")));
  ASSERT_EQ(known.joints().size(), 1u);
  EXPECT_EQ(known.joints()[0].model.doubt, 1);
  EXPECT_EQ(known.joints()[0].model.radius, test::doorModel().radius);
  LearnedModel drawer = test::drawerModel();
  drawer.id = 3;
  see(&known, {drawer});
  EXPECT_EQ(known.at(3).type, JointType::kPrismatic) << "learned better";
  EXPECT_EQ(known.joints()[0].model.doubt, 0);
}

TEST(KnownFronts, ForgetsOneAndNoOther) {
  KnownFronts known;
  see(&known, {test::restingModel(), test::doorModel(), test::drawerModel()});
  see(&known, {test::restingModel(), test::drawerModel()});
  EXPECT_EQ(known.forget(3).radius, test::doorModel().radius) << "out of view";
  EXPECT_EQ(known.forget(1).id, 1u) << "in view, and no joint";
  EXPECT_THAT([&] { known.forget(3); }, ThrowsSaying<ModelError>("there is no front 3; the fronts known are 4"));
  EXPECT_EQ(known.joints().size(), 1u);
}

TEST(KnownFronts, MemoryIsBoundedAndTheLeastSeenGoFirst) {
  KnownFronts known;
  for (std::uint32_t id = 1; id <= KnownFronts::kMostRemembered + 10; ++id) {
    LearnedModel model = test::doorModel();
    model.id = id;
    model.observations = id % 2 == 0 ? 500 : 20 + static_cast<int>(id);
    Track track = trackOf(model);
    track.observations.resize(1000);
    known.follow({{track}});
    known.update({model});
  }
  see(&known, {});
  const std::vector<KnownFront> joints = known.joints();
  ASSERT_EQ(joints.size(), KnownFronts::kMostRemembered);
  EXPECT_EQ(joints[0].model.id, 2u);
  EXPECT_EQ(joints[9].model.id, 20u) << "1 to 19 but for the even ones are gone";
  EXPECT_LE(joints[0].track.observations.size(), static_cast<size_t>(kKeptObservations));
}

TEST(KnownFronts, ReplacingForgetsEverythingElse) {
  KnownFronts known;
  see(&known, {test::doorModel()});
  known.replace({{test::drawerModel(), trackOf(test::drawerModel())}});
  EXPECT_THROW(known.at(3), ModelError);
  EXPECT_EQ(known.joints().size(), 1u);
}

}  // namespace
}  // namespace cabinet_articulation::core
