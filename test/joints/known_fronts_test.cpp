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
  EXPECT_EQ(known.forget(3).model.radius, test::doorModel().radius) << "out of view";
  EXPECT_EQ(known.forget(1).model.id, 1u) << "in view, and no joint";
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

TEST(KnownFronts, NamesStayWithTheirIds) {
  KnownFronts known;
  see(&known, {test::restingModel(), test::doorModel()});
  known.setName(1, "tray");
  known.setName(3, "fridge");
  EXPECT_EQ(known.at(3).name, "fridge") << "at once";
  std::vector<LearnedModel> learned{test::restingModel(), test::doorModel()};
  known.giveNames(&learned);
  EXPECT_EQ(learned[1].name, "fridge");
  LearnedModel drawer = test::drawerModel();
  drawer.id = 3;
  see(&known, {drawer});
  EXPECT_EQ(known.at(3).name, "fridge") << "of another type";
  see(&known, {});
  EXPECT_EQ(known.at(3).name, "fridge") << "out of view";
  EXPECT_EQ(known.joints().at(0).model.name, "fridge");
  known.setName(3, "freezer");
  EXPECT_EQ(known.jointModels().at(0).name, "freezer") << "given while it is out of view";
  see(&known, {test::restingModel()});
  EXPECT_EQ(known.at(1).name, "tray") << "its id has come back";
  KnownFronts restarted;
  restarted.replace(known.joints());
  see(&restarted, {test::restingModel(), test::doorModel()});
  EXPECT_EQ(restarted.at(3).name, "freezer");
  EXPECT_EQ(restarted.at(1).name, "") << "who was no joint is another";
}

TEST(KnownFronts, AForgottenNameIsFree) {
  KnownFronts known;
  see(&known, {test::restingModel(), test::doorModel()});
  known.setName(3, "fridge");
  known.forget(3);
  known.setName(1, "fridge");
  see(&known, {test::restingModel(), test::doorModel()});
  EXPECT_EQ(known.at(3).name, "");
  see(&known, {test::doorModel()});
  known.setName(3, "fridge");
  see(&known, {test::restingModel(), test::doorModel()});
  EXPECT_EQ(known.at(1).name, "") << "nobody knew it when its name was given away";
}

TEST(KnownFronts, RefuseANameWithAReasonAndAProposal) {
  KnownFronts known;
  see(&known, {test::restingModel(), test::doorModel(), test::drawerModel()});
  known.setName(3, "fridge");
  const auto expectRefused = [&](std::uint32_t id, const std::string& name, const std::string& why, const std::string& proposal) {
    try {
      known.setName(id, name, "map");
      ADD_FAILURE() << name;
    } catch (const NameError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
      EXPECT_THAT(error.what(), HasSubstr("; '" + proposal + "' would do"));
      EXPECT_EQ(error.proposal(), proposal);
    }
    EXPECT_EQ(known.at(3).name, "fridge");
    EXPECT_EQ(known.at(4).name, "");
  };
  expectRefused(4, "fridge", "'fridge' is the name of front 3", "fridge_2");
  expectRefused(4, "", "is empty", "front_4");
  expectRefused(3, "", "is empty", "front_3");
  expectRefused(4, "top drawer", "character at position 4", "top_drawer");
  expectRefused(4, "front_3", "'front_3' is what front 3 is called without a name", "front_3_2");
  expectRefused(4, "3", "does not begin with a letter", "front_3_2");
  expectRefused(4, "map", "frame that all models are in", "map_2");
  EXPECT_THAT([&] { known.setName(7, "fridge"); }, ThrowsSaying<ModelError>("there is no front 7; the fronts known are 1, 3, 4"));
  known.setName(3, "fridge");
  known.setName(3, "front_3");
  EXPECT_EQ(nameOf(known.at(3)), "front_3") << "its own default";
  known.setName(4, "fridge");
}

TEST(KnownFronts, NamesAreBounded) {
  KnownFronts known;
  LearnedModel resting = test::restingModel();
  for (std::uint32_t id = 1; id <= 3000; ++id) {
    resting.id = id;
    see(&known, {resting});
    known.setName(id, "tray_" + std::to_string(id));
  }
  resting.id = 1;
  see(&known, {resting});
  EXPECT_EQ(known.at(1).name, "") << "too long ago";
  resting.id = 2999;
  see(&known, {resting});
  EXPECT_EQ(known.at(2999).name, "tray_2999");
}

TEST(KnownFronts, NamedFrontsAreForgottenLast) {
  KnownFronts known;
  for (std::uint32_t id = 1; id <= KnownFronts::kMostRemembered + 1; ++id) {
    LearnedModel model = test::doorModel();
    model.id = id;
    model.observations = 20 + static_cast<int>(id);
    see(&known, {model});
    if (id == 1) known.setName(1, "fridge");
  }
  see(&known, {});
  EXPECT_EQ(known.at(1).name, "fridge");
  EXPECT_THROW(known.at(2), ModelError);
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
