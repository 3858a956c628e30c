// SPDX-License-Identifier: BSD-3-Clause
#include "joints/front_merge.h"

#include <gmock/gmock.h>

#include "joints/learned_fronts.h"

namespace cabinet_articulation::core {
namespace {

using test::learned;
using test::moved;
using testing::ElementsAre;

std::vector<std::uint32_t> idsOf(const std::vector<KnownFront>& fronts) {
  std::vector<std::uint32_t> ids;
  for (const KnownFront& front : fronts) ids.push_back(front.model.id);
  return ids;
}

TEST(SamePlace, IsThatOfAFrontSeenElsewhereAlongItsWay) {
  for (LearnedModel model : {test::doorModel(), test::drawerModel(), test::garageModel()}) {
    EXPECT_LT(samePlace(model, model).value_or(1), 1e-6) << model.id;
    LearnedModel later = moved(model, {0.03, 0, 0});  // the map is a little elsewhere today
    later.id = 99;
    EXPECT_TRUE(samePlace(model, later)) << model.id;
    EXPECT_NEAR(*samePlace(model, later), *samePlace(later, model), 1e-12);
  }
  LearnedModel first = test::drawerModel(), second = test::drawerModel();
  first.q_max = 0.1;
  second.q_min = 0.18;
  EXPECT_TRUE(samePlace(first, second)) << "two parts of one way";
}

TEST(SamePlace, KnowsAFrontWhoseJointWasMistaken) {
  LearnedModel door = test::doorModel(), drawer = test::doorModel();
  drawer.type = JointType::kPrismatic;
  drawer.axis = -Eigen::Vector3d::UnitZ();
  drawer.q_max = 0.05;
  EXPECT_TRUE(samePlace(door, drawer)) << "closed, both are in one place";
}

TEST(SamePlace, TakesASideNobodySawForAny) {
  LearnedModel marker = test::doorModel();
  marker.width = marker.height = 0;
  EXPECT_TRUE(samePlace(marker, test::doorModel()));
}

TEST(SamePlace, IsNotThatOfANeighbour) {
  const LearnedModel drawer = test::drawerModel();
  EXPECT_FALSE(samePlace(drawer, moved(drawer, {0, drawer.height, 0}))) << "the drawer below, 0.15 m high";
  EXPECT_FALSE(samePlace(drawer, moved(drawer, {drawer.width, 0, 0})));
  LearnedModel low = drawer;
  low.height = 0.06;
  EXPECT_FALSE(samePlace(low, moved(low, {0, 0.03, 0}))) << "half a side away";
  LearnedModel larger = drawer;
  larger.height += 0.08;
  EXPECT_FALSE(samePlace(drawer, larger));
  LearnedModel turned = drawer;
  turned.origin.rotate(Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY()));
  EXPECT_FALSE(samePlace(drawer, turned));
}

TEST(SamePlace, InACornerADoorIsNotTheFrontItOpensAgainst) {
  // The door's hinge is in the corner; opened by 90 degrees its face touches the other front's.
  LearnedModel door = test::doorModel();
  door.q_max = M_PI / 2;
  LearnedModel other = test::drawerModel();
  other.width = door.width;
  other.height = door.height;
  other.origin = door.predict(M_PI / 2) * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY());
  other.axis = other.origin.linear().col(2);
  EXPECT_FALSE(samePlace(door, other));
}

TEST(Merge, JoinsByPlaceAndNotByNumber) {
  KnownFront door = learned(test::doorModel()), drawer = learned(test::drawerModel());
  KnownFront door_in_file = door, drawer_in_file = drawer;
  test::setId(4, &door_in_file);  // the numbers of an earlier run are the other way round
  test::setId(3, &drawer_in_file);
  const MergedFronts merged = mergeFronts({door, drawer}, {door_in_file, drawer_in_file}, {});
  ASSERT_THAT(idsOf(merged.fronts), ElementsAre(3, 4));
  EXPECT_EQ(merged.fronts[0].model.type, JointType::kRotational);
  EXPECT_EQ(merged.from_file, 0u);
  EXPECT_TRUE(merged.changes.empty());
}

TEST(Merge, KeepsWhatOnlyTheFileKnowsUnderAFreeId) {
  KnownFront garage = learned(test::garageModel());
  const MergedFronts merged = mergeFronts({learned(test::doorModel())}, {learned(test::drawerModel()), garage}, {});
  EXPECT_THAT(idsOf(merged.fronts), ElementsAre(3, 4, 6));
  EXPECT_EQ(merged.from_file, 2u);
  test::setId(3, &garage);
  const MergedFronts changed = mergeFronts({learned(test::doorModel())}, {learned(test::drawerModel()), garage}, {});
  EXPECT_THAT(idsOf(changed.fronts), ElementsAre(3, 4, 5));
  EXPECT_EQ(changed.fronts[2].model.type, JointType::kNonparametric);
  EXPECT_EQ(changed.fronts[2].track.id, 5u);
  EXPECT_EQ(inWords(changed.changes), "front 3 of the file is front 5 now");
}

TEST(Merge, TwoFrontsOfOnePlaceStayTwo) {
  std::vector<KnownFront> fronts{learned(test::doorModel()), learned(test::doorModel())};
  test::setId(9, &fronts[1]);
  fronts[0].model.q = 0.1;
  fronts[1].model.q = 0.9;
  const MergedFronts merged = mergeFronts(fronts, fronts, {});
  ASSERT_THAT(idsOf(merged.fronts), ElementsAre(3, 9)) << "each is its own counterpart";
  EXPECT_EQ(merged.fronts[0].model.q, 0.1);
}

/// A drawer in a trolley, whose face is front 3.
KnownFront hangingDrawer(std::uint32_t id, std::uint32_t parent) {
  KnownFront drawer = learned(test::drawerModel());
  test::setId(id, &drawer);
  drawer.model.parent = parent;
  return drawer;
}

TEST(Merge, WhatHangsOnAnotherIsToldByThatAndFollowsItsNumber) {
  const KnownFront face = learned(test::doorModel());
  KnownFront face_in_file = face;
  test::setId(8, &face_in_file);
  MergedFronts merged = mergeFronts({face, hangingDrawer(4, 3)}, {face_in_file, hangingDrawer(9, 8)}, {});
  ASSERT_THAT(idsOf(merged.fronts), ElementsAre(3, 4)) << "one trolley, one drawer";
  EXPECT_EQ(merged.fronts[1].model.parent, 3U);
  merged = mergeFronts({face}, {face_in_file, hangingDrawer(9, 8)}, {});
  ASSERT_THAT(idsOf(merged.fronts), ElementsAre(3, 9));
  EXPECT_EQ(merged.fronts[1].model.parent, 3U) << "the file's drawer hangs on the face that is known now";
}

TEST(Merge, DrawersOfTwoTrolleysAreTwo) {
  const KnownFront face = learned(test::doorModel());
  KnownFront other_face = learned(test::moved(test::doorModel(), {2, 0, 0}));
  const MergedFronts merged = mergeFronts({face, hangingDrawer(4, 3)}, {other_face, hangingDrawer(4, 3)}, {});
  ASSERT_THAT(idsOf(merged.fronts), ElementsAre(3, 4, 5, 6));
  EXPECT_EQ(merged.fronts[1].model.parent, 3U);
  EXPECT_EQ(merged.fronts[3].model.parent, 5U);
}

TEST(Merge, WhatHangsOnWhatWasRemovedGoesWithIt) {
  const KnownFront face = learned(test::doorModel());
  const MergedFronts merged = mergeFronts({}, {face, hangingDrawer(4, 3)}, {face.model});
  EXPECT_TRUE(merged.fronts.empty());
}

TEST(Merge, AWellKnownFrontIsNotReplacedByAGlimpse) {
  const KnownFront file = learned(test::doorModel(), 150, 1000);
  KnownFront glimpse = learned(test::doorModel(), 20, 5000);
  test::setId(8, &glimpse);
  const MergedFronts kept = mergeFronts({glimpse}, {file}, {});
  ASSERT_THAT(idsOf(kept.fronts), ElementsAre(8)) << "the number it has now";
  EXPECT_EQ(kept.fronts[0].model.observations, 150);
  EXPECT_EQ(kept.from_file, 1u);
  const MergedFronts replaced = mergeFronts({learned(test::doorModel(), 80, 5000)}, {file}, {});
  EXPECT_EQ(replaced.fronts.at(0).model.observations, 80) << "half as many are no glimpse";
  const MergedFronts endless = mergeFronts({learned(test::doorModel(), 110, 5000)}, {learned(test::doorModel(), 2000, 1000)}, {});
  EXPECT_EQ(endless.fronts.at(0).model.observations, 110) << "beyond what a file keeps, more do not count";
}

TEST(Merge, WhatGoesOnFromTheFileAlwaysReplacesIt) {
  const KnownFront file = learned(test::doorModel(), 200, 1000);
  KnownFront known = file;
  known.model.observations = 60;  // thinned out since
  known.model.q_max = 1.4;
  known.track.observations.push_back(known.track.observations.back());
  known.track.observations.back().stamp += 1;
  EXPECT_EQ(mergeFronts({known}, {file}, {}).fronts.at(0).model.q_max, 1.4);
  known.model.doubt = 1;
  EXPECT_EQ(mergeFronts({known}, {file}, {}).fronts.at(0).model.doubt, 1) << "saved with its doubt";
}

TEST(Merge, WhatIsGivenUpReplacesNoJointOfAnotherRun) {
  KnownFront doubted = learned(test::doorModel(), 150, 5000);
  doubted.model.doubt = 1;
  EXPECT_EQ(mergeFronts({doubted}, {learned(test::doorModel(), 100, 1000)}, {}).fronts.at(0).model.doubt, 0);
  EXPECT_EQ(mergeFronts({learned(test::doorModel(), 20, 1000)}, {doubted}, {}).fronts.at(0).model.doubt, 0);
}

TEST(Merge, WhatWasRemovedDoesNotComeBack) {
  KnownFront door_in_file = learned(test::doorModel(), 200, 1000);
  test::setId(77, &door_in_file);
  const std::vector<KnownFront> file{door_in_file, learned(test::drawerModel())};
  EXPECT_THAT(idsOf(mergeFronts({}, file, {test::doorModel()}).fronts), ElementsAre(4));
  const MergedFronts again = mergeFronts({learned(test::doorModel(), 15, 5000)}, file, {test::doorModel()});
  ASSERT_THAT(idsOf(again.fronts), ElementsAre(3, 4));
  EXPECT_EQ(again.fronts[0].model.observations, 15) << "learned anew, and no match for the old one's evidence";
}

KnownFront named(const std::string& name, LearnedModel model, int observations, double stamp) {
  model.name = name;
  return learned(model, observations, stamp);
}

TEST(Merge, AFrontKeepsItsNameWhicheverModelStays) {
  const KnownFront file = named("fridge", test::doorModel(), 150, 1000);
  for (const int observations : {20, 100}) {
    KnownFront known = learned(test::doorModel(), observations, 5000);
    test::setId(8, &known);
    EXPECT_EQ(mergeFronts({known}, {file}, {}).fronts.at(0).model.name, "fridge") << observations;
    known.model.name = "freezer";
    const MergedFronts merged = mergeFronts({known}, {file}, {});
    EXPECT_EQ(merged.fronts.at(0).model.name, "freezer") << "given later: " << observations;
    EXPECT_EQ(merged.fronts.at(0).model.id, 8u);
    EXPECT_TRUE(merged.renamed.empty());
  }
}

TEST(Merge, ANameIsThereOnce) {
  const KnownFront door = named("fridge", test::doorModel(), 50, 5000);
  KnownFront drawer = named("fridge", test::drawerModel(), 50, 1000), garage = named("fridge_2", test::garageModel(), 50, 1000);
  const MergedFronts merged = mergeFronts({door}, {drawer, garage}, {});
  ASSERT_EQ(merged.fronts.size(), 3u);
  EXPECT_EQ(merged.fronts[0].model.name, "fridge") << "known now";
  EXPECT_EQ(merged.fronts[1].model.name, "fridge_3");
  EXPECT_EQ(merged.fronts[2].model.name, "fridge_2");
  ASSERT_EQ(merged.renamed.size(), 1u);
  EXPECT_EQ(merged.renamed[0].id, 4u);
  EXPECT_EQ(merged.renamed[0].from, "fridge");
  EXPECT_EQ(merged.renamed[0].to, "fridge_3");
}

TEST(Merge, ADefaultNameIsLostWithItsId) {
  const KnownFront file = named("front_3", test::doorModel(), 50, 1000);
  KnownFront known = learned(test::doorModel(), 50, 5000);
  test::setId(8, &known);
  EXPECT_EQ(mergeFronts({known}, {file}, {}).fronts.at(0).model.name, "");
  KnownFront other = learned(test::drawerModel(), 50, 5000);
  test::setId(3, &other);
  const MergedFronts merged = mergeFronts({other}, {file}, {});
  ASSERT_THAT(idsOf(merged.fronts), ElementsAre(3, 4));
  EXPECT_EQ(nameOf(merged.fronts[1].model), "front_4");
}

TEST(Ids, OfNobodyAreReplaced) {
  std::vector<KnownFront> fronts{learned(test::doorModel()), learned(test::drawerModel())};
  test::setId(0, &fronts[0]);
  std::vector<std::uint32_t> taken;
  EXPECT_EQ(inWords(giveFreeIds(&fronts, &taken)), "front 0 of the file is front 5 now");
  EXPECT_EQ(fronts[0].track.id, 5u);
  EXPECT_THAT(taken, ElementsAre(4, 5));
}

TEST(Ids, ThatAreUsedUpBeginAnew) {
  std::vector<KnownFront> fronts{learned(test::doorModel()), learned(test::drawerModel())};
  test::setId(kLargestId, &fronts[0]);
  test::setId(0, &fronts[1]);
  std::vector<std::uint32_t> taken{1};
  giveFreeIds(&fronts, &taken);
  EXPECT_THAT(idsOf(fronts), ElementsAre(kLargestId, 2));
}

}  // namespace
}  // namespace cabinet_articulation::core
