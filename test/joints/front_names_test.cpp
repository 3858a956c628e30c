// SPDX-License-Identifier: BSD-3-Clause
#include "joints/front_names.h"

#include <gmock/gmock.h>

#include <set>

#include "cabinet_articulation/joints/joint.h"
#include "support/models.h"

namespace cabinet_articulation::core {
namespace {

using testing::HasSubstr;

bool anyIsFree(const std::string&) { return true; }

TEST(FrontNames, ADefaultSurvivesAChangeOfType) {
  LearnedModel model = test::doorModel();
  EXPECT_EQ(nameOf(model), "front_3");
  model.type = JointType::kPrismatic;
  EXPECT_EQ(nameOf(model), "front_3");
  model.name = "fridge";
  EXPECT_EQ(nameOf(model), "fridge");
}

TEST(FrontNames, DefaultsBelongToOneFront) {
  EXPECT_EQ(ownerOfDefaultName("front_3"), 3u);
  EXPECT_EQ(ownerOfDefaultName("front_4294967295"), 4294967295u);
  for (const char* const name : {"front_", "front_03", "front_3_", "front_3a", "front_99999999999", "front_-1", "Front_3", "3"})
    EXPECT_FALSE(ownerOfDefaultName(name)) << name;
}

TEST(FrontNames, FitEverywhereInRos) {
  for (const char* const name : {"fridge", "Top_Drawer_2", "x", "null", "true", "a__b_"}) EXPECT_EQ(whyUnfit(name), "") << name;
  EXPECT_EQ(whyUnfit(std::string(kLongestName, 'a')), "");
  EXPECT_THAT(whyUnfit(""), HasSubstr("empty"));
  EXPECT_THAT(whyUnfit(std::string(kLongestName + 1, 'a')), HasSubstr("has 65 characters, expected 64 at most"));
  for (const char* const name : {"3", "_fridge", "/fridge", " fridge", "\u00fcber"})
    EXPECT_THAT(whyUnfit(name), HasSubstr("does not begin with a letter")) << name;
  for (const char* const name : {"top drawer", "k\u00fchl", "a/b", "a-b", "a<b", "a\"b", "a\nb"})
    EXPECT_THAT(whyUnfit(name), HasSubstr("at position ")) << name;
  EXPECT_THAT(whyUnfit(std::string("a\0b", 3)), HasSubstr("at position 2"));
}

TEST(FrontNames, ProposalsAreNear) {
  const auto proposed = [](const std::string& wanted) { return proposeName(wanted, 3, anyIsFree); };
  EXPECT_EQ(proposed("top drawer"), "top_drawer");
  EXPECT_EQ(proposed("/kitchen/k\u00fchlschrank <2>"), "kitchen_k_hlschrank_2");
  EXPECT_EQ(proposed("3rd"), "front_3rd");
  for (const char* const nothing : {"", "___", "\xff\xff"}) EXPECT_EQ(proposed(nothing), "front_3") << nothing;
  EXPECT_EQ(proposed(std::string(1000000, 'a')), std::string(kLongestName, 'a'));
}

TEST(FrontNames, ProposalsFitAndAreFree) {
  std::set<std::string> taken{"fridge", "fridge_2", std::string(kLongestName, 'a')};
  const auto is_free = [&](const std::string& name) { return taken.count(name) == 0; };
  EXPECT_EQ(proposeName("fridge", 3, is_free), "fridge_3");
  EXPECT_EQ(proposeName(std::string(kLongestName, 'a'), 3, is_free), std::string(kLongestName - 2, 'a') + "_2");
  for (const std::string wanted : {"", "4", "x y", "\x01", "fridge", "9 fridges"})
    for (int i = 0; i < 12; ++i) {
      const std::string name = proposeName(wanted, 3, is_free);
      EXPECT_EQ(whyUnfit(name), "") << name;
      EXPECT_TRUE(taken.insert(name).second) << name;
    }
}

}  // namespace
}  // namespace cabinet_articulation::core
