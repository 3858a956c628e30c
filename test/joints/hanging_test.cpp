// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/hanging.h"

#include <gmock/gmock.h>

#include <cstddef>
#include <ctime>

#include "cabinet_articulation/geometry/limits.h"
#include "support/models.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::ThrowsSaying;
using testing::AllOf;
using testing::HasSubstr;

/// A rack in the door of test::doorModel(), 0.1 m behind its surface; it slides along the door's normal.
LearnedModel rack() {
  LearnedModel rack = test::drawerModel();
  rack.parent = 3;
  rack.origin = Eigen::Isometry3d(Eigen::Translation3d(0.02, -0.1, -0.1));
  rack.axis = Eigen::Vector3d::UnitZ();
  return rack;
}

TEST(Hanging, FollowsTheParentWhereItIs) {
  LearnedModel door = test::doorModel();
  for (const double opening : {0.0, 0.5, 1.2}) {
    door.q = opening;
    const LearnedModel seen = placed(rack(), {door, rack()});
    for (const double q : {0.0, 0.3})
      EXPECT_TRUE(seen.predict(q).isApprox(door.predict(opening) * rack().predict(q), 1e-12)) << opening << ' ' << q;
  }
}

TEST(Hanging, ParentsAreAddedOnce) {
  const LearnedModel door = test::doorModel();
  LearnedModel box = rack();
  box.id = 9;
  box.parent = 4;
  std::vector<std::uint32_t> ids;
  for (const LearnedModel& model : withParents({box, door}, {rack(), door, box})) ids.push_back(model.id);
  EXPECT_THAT(ids, testing::ElementsAre(9, 3, 4));
  EXPECT_EQ(withParents({rack()}, {}).size(), 1U);
}

TEST(Hanging, ChainsGoOnToTheWorld) {
  const LearnedModel door = test::doorModel();
  LearnedModel box = rack();
  box.id = 9;
  box.parent = 4;
  const LearnedModel seen = placed(box, {box, rack(), door});
  EXPECT_TRUE(seen.predict(0.1).isApprox(door.predict(door.q) * rack().predict(rack().q) * box.predict(0.1), 1e-12));
}

TEST(Hanging, OnTheWorldIsAsItWas) {
  const LearnedModel door = test::doorModel();
  EXPECT_EQ(placed(door, {}).origin.matrix(), door.origin.matrix());
  EXPECT_EQ(allPlaced({test::restingModel(), door}).size(), 2U);
}

TEST(Hanging, OnNothingThatIsKnownIsAnErrorInWords) {
  EXPECT_THAT([] { placed(rack(), {rack()}); },
              ThrowsSaying<ModelError>(HasSubstr("front 4 hangs on front 3, which is not known")));
  EXPECT_TRUE(allPlaced({rack()}).empty());
  LearnedModel still = test::restingModel();
  still.id = 3;
  EXPECT_THAT([&] { placed(rack(), {still}); }, ThrowsSaying<ModelError>(HasSubstr("front 3 has not moved enough")));
}

TEST(Hanging, InACycleIsRefusedInWords) {
  LearnedModel door = test::doorModel();
  door.parent = 4;
  const auto words = AllOf(HasSubstr("front 3"), HasSubstr("front 4"), HasSubstr("in a cycle"));
  EXPECT_THAT([&] { requireNoCycle({door, rack()}); }, ThrowsSaying<ModelError>(words));
  EXPECT_THAT([&] { placed(door, {door, rack()}); }, ThrowsSaying<ModelError>(words));
  EXPECT_TRUE(allPlaced({door, rack()}).empty());
  door.parent = 3;
  EXPECT_THAT([&] { requireNoCycle({door}); }, ThrowsSaying<ModelError>(HasSubstr("in a cycle")));
  EXPECT_NO_THROW(requireNoCycle({test::doorModel(), rack()}));
}

/// `count` fronts with the ids from 1 on, each on the next; the last one on `last`.
std::vector<LearnedModel> chainOf(std::size_t count, std::uint32_t last) {
  std::vector<LearnedModel> chain(count, test::drawerModel());
  for (std::size_t i = 0; i < count; ++i) {
    chain[i].id = static_cast<std::uint32_t>(i + 1);
    chain[i].parent = i + 1 < count ? chain[i].id + 1 : last;
  }
  return chain;
}

TEST(Hanging, ALongChainIsRefusedInWords) {
  const std::vector<LearnedModel> longest = chainOf(limits::kMostParents + 1, 0), longer = chainOf(limits::kMostParents + 2, 0);
  EXPECT_NO_THROW(requireNoCycle(longest));
  EXPECT_EQ(allPlaced(longest).size(), longest.size());
  EXPECT_THAT([&] { requireNoCycle(longer); },
              ThrowsSaying<ModelError>(HasSubstr("which hangs on front 10; expected at most 8")));
  EXPECT_EQ(allPlaced(longer).size(), longest.size());
}

TEST(Hanging, AMessageOfOneChainTakesNoLongerThanItsFronts) {
  const std::clock_t start = std::clock();
  EXPECT_EQ(allPlaced(chainOf(limits::kMostFronts, 0)).size(), limits::kMostParents + 1);
  EXPECT_TRUE(allPlaced(chainOf(limits::kMostFronts, 1)).empty());
  EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 2);  // 20 s where each looks for all above it
}

}  // namespace
}  // namespace cabinet_articulation::core
