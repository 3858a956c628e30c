// SPDX-License-Identifier: BSD-3-Clause
// Fronts that hang on others, when one of them is forgotten, or a file describes their parent from another edge.
#include <gmock/gmock.h>

#include "cabinet_articulation/joints/hanging.h"
#include "joints/front_merge.h"
#include "joints/learned_fronts.h"
#include "joints/removed_fronts.h"

namespace cabinet_articulation::core {
namespace {

using testing::ElementsAre;

std::vector<std::uint32_t> idsOf(const std::vector<KnownFront>& fronts) {
  std::vector<std::uint32_t> ids;
  for (const KnownFront& front : fronts) ids.push_back(front.model.id);
  return ids;
}

/// The first leaf of a folding door.
KnownFront leaf(std::uint32_t id, double x) {
  KnownFront front = test::learned(test::moved(test::doorModel(), {x, 0, 0}));
  test::setId(id, &front);
  return front;
}

/// The second leaf, hinged at the first one's edge.
KnownFront secondLeaf(std::uint32_t id, const LearnedModel& first) {
  LearnedModel model = first;
  model.origin = Eigen::Isometry3d(Eigen::Translation3d(first.width, 0, 0));
  model.axis = Eigen::Vector3d::UnitY();
  model.axis_point = {first.width / 2, 0, 0};
  model.parent = first.id;
  KnownFront front = test::learned(model);
  test::setId(id, &front);
  return front;
}

std::vector<KnownFront> twoFoldingDoors() {
  const KnownFront first = leaf(1, 0), third = leaf(3, 2);
  return {first, secondLeaf(2, first.model), third, secondLeaf(4, third.model)};
}

KnownFronts known(const std::vector<KnownFront>& fronts) {
  KnownFronts known;
  known.replace(fronts);
  return known;
}

TEST(Forgotten, ALeafIsNotTheEqualLeafOfAnotherDoor) {
  const ForgottenFront forgotten = known(twoFoldingDoors()).forget(2);
  EXPECT_THAT(idsOf(mergeFronts({}, twoFoldingDoors(), {forgotten}).fronts), ElementsAre(1, 3, 4));
  RemovedFronts removed;
  removed.add(forgotten);
  removed.saved("kitchen.yaml", {twoFoldingDoors()[2], twoFoldingDoors()[3]});
  EXPECT_EQ(removed.in("kitchen.yaml").size(), 1U) << "saved was the other door's";
  removed.loaded({twoFoldingDoors()[2], twoFoldingDoors()[3]});
  EXPECT_FALSE(removed.empty());
  removed.loaded(twoFoldingDoors());
  EXPECT_TRUE(removed.empty());
}

TEST(Forgotten, IsFoundWhereverItsParentWasWhenItWasSaved) {
  const std::vector<KnownFront> file = twoFoldingDoors();
  std::vector<KnownFront> now = file;
  now[0].model.q = 0.7;
  now[1].model.q = 0.4;
  EXPECT_THAT(idsOf(mergeFronts({}, file, {known(now).forget(2)}).fronts), ElementsAre(1, 3, 4));
}

TEST(Forgotten, WhatHungOnItStaysWhereItIs) {
  const std::vector<KnownFront> before = twoFoldingDoors();
  KnownFronts fronts = known(before);
  const Eigen::Isometry3d place = placed(before[1].model, modelsOf(before)).predict(before[1].model.q);
  const ForgottenFront forgotten = fronts.forget(1);
  EXPECT_THAT(forgotten.set_down, ElementsAre(2));
  EXPECT_EQ(childrenInWords(forgotten), ", and front 2, which hung on it, hangs on the world now");
  EXPECT_EQ(fronts.at(2).parent, 0U);
  EXPECT_TRUE(fronts.at(2).predict(before[1].model.q).isApprox(place, 1e-9));
  EXPECT_EQ(fronts.at(4).parent, 3U);
}

TEST(Forgotten, TakesAlongWhatHasNoPlaceWithoutIt) {
  std::vector<KnownFront> fronts = twoFoldingDoors();
  fronts[0].model.doubt = 1;  // given up
  KnownFronts all = known(fronts);
  const ForgottenFront forgotten = all.forget(1);
  EXPECT_THAT(forgotten.lost, ElementsAre(2));
  EXPECT_THAT(childrenInWords(forgotten), testing::HasSubstr("front 2, which hung on it at a place that nobody knows"));
  EXPECT_THAT(idsOf(all.joints()), ElementsAre(3, 4));
}

TEST(Remembered, AParentIsNotEvictedBeforeItsChildren) {
  std::vector<KnownFront> fronts{leaf(1, 0)};
  fronts[0].model.observations = 10;  // the fewest of all
  fronts.push_back(secondLeaf(2, fronts[0].model));
  fronts[1].model.observations = 50;
  for (std::uint32_t id = 3; id <= KnownFronts::kMostRemembered + 1; ++id) {
    LearnedModel model = test::doorModel();
    model.id = id;
    model.observations = 20;
    fronts.push_back({model, {}});
  }
  KnownFronts all = known(fronts);
  EXPECT_EQ(all.joints().size(), KnownFronts::kMostRemembered);
  EXPECT_EQ(all.at(1).observations, 10);
  EXPECT_EQ(all.at(2).parent, 1U);
}

/// The same front, described with its axes turned by 90 degrees about the normal, and what hangs on it in that frame.
std::vector<KnownFront> turned(const KnownFront& parent, const KnownFront& child) {
  const Eigen::Isometry3d quarter(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
  std::vector<KnownFront> result{parent, child};
  result[0].model.origin = parent.model.origin * quarter;
  std::swap(result[0].model.width, result[0].model.height);
  result[1].model = transformed(child.model, quarter.inverse());
  return result;
}

TEST(Merge, ChildrenHangOnTheSamePartOfAParentThatIsDescribedFromAnotherEdge) {
  const std::vector<KnownFront> now{leaf(1, 0), secondLeaf(2, leaf(1, 0).model)};
  const Eigen::Isometry3d place = placed(now[1].model, modelsOf(now)).predict(0.3);
  const std::vector<KnownFront> file = turned(now[0], now[1]);
  ASSERT_TRUE(placed(file[1].model, modelsOf(file)).predict(0.3).isApprox(place, 1e-9));
  for (const bool child_known : {false, true}) {
    const std::vector<KnownFront> known(now.begin(), now.begin() + (child_known ? 2 : 1));
    const std::vector<KnownFront> merged = mergeFronts(known, file, {}).fronts;
    ASSERT_THAT(idsOf(merged), ElementsAre(1, 2)) << child_known;
    EXPECT_TRUE(placed(merged[1].model, modelsOf(merged)).predict(0.3).isApprox(place, 1e-9)) << child_known;
  }
  // The file's parent is much better known, and takes the place of the one that the child was learned on.
  std::vector<KnownFront> better = file;
  better[0] = turned(test::learned(now[0].model, 100, 1000), now[1])[0];
  const std::vector<KnownFront> merged = mergeFronts(now, {better[0]}, {}).fronts;
  ASSERT_THAT(idsOf(merged), ElementsAre(1, 2));
  EXPECT_EQ(merged[0].model.observations, 100);
  EXPECT_TRUE(placed(merged[1].model, modelsOf(merged)).predict(0.3).isApprox(place, 1e-9));
}

TEST(Merge, AFrontThatHangsOnAnotherParentSinceIsSavedOnce) {
  const std::vector<KnownFront> file = twoFoldingDoors();
  std::vector<KnownFront> now = file;
  now[1].model = setDown(now[1].model, modelsOf(now));
  EXPECT_THAT(idsOf(mergeFronts(now, file, {}).fronts), ElementsAre(1, 2, 3, 4));
  now[1].model = secondLeaf(2, now[2].model).model;
  EXPECT_THAT(idsOf(mergeFronts(now, file, {}).fronts), ElementsAre(1, 2, 3, 4));
}

}  // namespace
}  // namespace cabinet_articulation::core
