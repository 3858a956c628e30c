// SPDX-License-Identifier: BSD-3-Clause
#include "ros/settings/parameters.h"

#include <gtest/gtest.h>

namespace cabinet_articulation {
namespace {

TEST(Parameters, KeepTheirTypes) {
  XmlRpc::XmlRpcValue value;
  value["flag"] = true;
  value["count"] = 3;
  value["ratio"] = 0.5;
  value["method"] = std::string("paper");
  std::vector<std::string> warnings;
  const core::ConfigValues expected{{"flag", true}, {"count", 3}, {"ratio", 0.5}, {"method", std::string("paper")}};
  EXPECT_EQ(toConfigValues(value, &warnings), expected);
  EXPECT_TRUE(warnings.empty());
}

TEST(Parameters, ListsAndGroupsAreNoSettings) {
  XmlRpc::XmlRpcValue value;
  value["planes"]["stride"] = 2;
  value["list"][0] = 1;
  value["count"] = 3;
  std::vector<std::string> warnings;
  EXPECT_EQ(toConfigValues(value, &warnings), (core::ConfigValues{{"count", 3}}));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[1], "setting 'planes' is a list or a group and is ignored; expected a single value");
}

TEST(Parameters, SingleValueIsNoGroup) {
  std::vector<std::string> warnings;
  EXPECT_THROW(toConfigValues(XmlRpc::XmlRpcValue(3), &warnings), core::ConfigError);
}

}  // namespace
}  // namespace cabinet_articulation
