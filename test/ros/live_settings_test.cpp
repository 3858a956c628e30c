// SPDX-License-Identifier: BSD-3-Clause
#include "ros/settings/live_settings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cabinet_articulation/kinds/kinds_config.h"

namespace cabinet_articulation {
namespace {

struct Config {
  bool refine = true;
  int stride = 2;
  double threshold = 0.5;
  std::string method = "fast";

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("refine", self.refine, "refines");
    visit("stride", self.stride, core::Range{1, 8}, "px", "strides");
    visit("threshold", self.threshold, core::Range{0, 1}, "", "decides");
    visit("method", self.method, core::Choices{"fast", "exact"}, "chooses");
  }
};

TEST(LiveSettings, DescriptionIsThatOfTheFields) {
  const auto description = describeForTuning<Config>();
  ASSERT_EQ(description.groups.size(), 1u);
  const auto& parameters = description.groups[0].parameters;
  ASSERT_EQ(parameters.size(), 4u);
  EXPECT_EQ(parameters[0].type, "bool");
  EXPECT_EQ(parameters[1].type, "int");
  EXPECT_EQ(parameters[1].description, "strides [px]");
  EXPECT_EQ(parameters[2].type, "double");
  EXPECT_EQ(parameters[3].type, "str");
  EXPECT_NE(parameters[3].edit_method.find("'value': 'exact'"), std::string::npos);
  EXPECT_EQ(description.min.ints.at(0).value, 1);
  EXPECT_EQ(description.max.ints.at(0).value, 8);
  EXPECT_EQ(description.dflt.ints.at(0).value, 2);
  EXPECT_EQ(description.max.doubles.at(0).value, 1);
  EXPECT_EQ(description.dflt.strs.at(0).value, "fast");
}

TEST(LiveSettings, ValuesGoThereAndBack) {
  Config config;
  config.refine = false;
  config.stride = 5;
  config.threshold = 0.25;
  config.method = "exact";
  Config back;
  EXPECT_TRUE(core::applyConfig(fromTuning(toTuning(config)), back).empty());
  EXPECT_FALSE(back.refine);
  EXPECT_EQ(back.stride, 5);
  EXPECT_EQ(back.threshold, 0.25);
  EXPECT_EQ(back.method, "exact");
}

TEST(LiveSettings, EveryDefaultLiesInItsRange) {
  const auto description = describeForTuning<core::LearningConfig>();
  for (size_t i = 0; i < description.dflt.doubles.size(); ++i) {
    EXPECT_LE(description.min.doubles[i].value, description.dflt.doubles[i].value) << description.dflt.doubles[i].name;
    EXPECT_GE(description.max.doubles[i].value, description.dflt.doubles[i].value) << description.dflt.doubles[i].name;
  }
}

}  // namespace
}  // namespace cabinet_articulation
