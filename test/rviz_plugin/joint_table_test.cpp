// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/joint_table.h"

#include <gtest/gtest.h>

#include "support/models.h"

namespace cabinet_articulation {
namespace {

TEST(JointTable, RowsSayWhatWasLearnedInWordsAndUnits) {
  const auto rows = jointRows({test::drawerModel(), test::doorModel()});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].id, 3u) << "ordered by id";
  EXPECT_EQ(rows[0].name, "front_3");
  EXPECT_EQ(rows[0].type, "rotational 97 %");
  EXPECT_EQ(rows[0].probabilities, "rigid 1 %\nprismatic 2 %\nrotational 97 %\nnonparametric 0 %");
  EXPECT_EQ(rows[0].q, "29 deg");
  EXPECT_EQ(rows[0].range, "0 to 69 deg");
  EXPECT_NEAR(rows[0].opening, 0.5 / 1.2, 1e-12) << "of the range seen";
  EXPECT_EQ(rows[0].state, "never seen closed");
  EXPECT_EQ(rows[1].q, "20.0 cm");
  EXPECT_EQ(rows[1].range, "0.0 to 30.0 cm");
}

TEST(JointTable, StatesAreWords) {
  core::LearnedModel door = test::doorModel(), drawer = test::drawerModel();
  door.closed_known = true;
  door.opening = 0.01;
  drawer.closed_known = true;
  drawer.opening = 0.6;
  drawer.name = "pots";
  drawer.parent = door.id;
  drawer.parent_probability = 0.9;
  const auto rows = jointRows({door, drawer, test::unexplainedModel()});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].state, "closed");
  EXPECT_EQ(rows[1].name, "pots");
  EXPECT_EQ(rows[1].state, "open, hangs on front_3 (90 %)");
  EXPECT_NEAR(rows[1].opening, 0.6, 1e-12);
  EXPECT_EQ(rows[2].state, "moved, no joint fits");
  EXPECT_EQ(rows[2].type, "");
}

TEST(JointTable, FrontsOfWhichThereIsNothingToTellAreCountedAlone) {
  core::LearnedModel wall = test::restingModel();
  EXPECT_TRUE(jointRows({wall}).empty());
  EXPECT_EQ(summaryOf({wall, test::doorModel()}), "1 joint; 1 front did not move");
  wall.name = "oven";
  ASSERT_EQ(jointRows({wall}).size(), 1u) << "who named it looks for it";
  EXPECT_EQ(jointRows({wall})[0].state, "no motion yet");
  EXPECT_EQ(summaryOf({}), "0 joints; 0 fronts did not move");
}

TEST(JointTable, NothingIsNegativeByRounding) {
  EXPECT_EQ(configurationText(test::drawerModel(), -1e-5), "0.0 cm");
  EXPECT_EQ(configurationText(test::doorModel(), -1e-3), "0 deg");
}

}  // namespace
}  // namespace cabinet_articulation
