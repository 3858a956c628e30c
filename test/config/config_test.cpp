// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/config/config.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <limits>

namespace cabinet_articulation::core {
namespace {

struct Example {
  int stride = 4;
  double distance = 0.02;
  bool refine = true;
  std::string method = "ours";

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("stride", self.stride, Range{1, 32}, "px", "every stride-th pixel");
    visit("distance", self.distance, Range{0, 1}, "m", "threshold");
    visit("refine", self.refine, "second pass");
    visit(Section{"Which way."});
    visit("method", self.method, Choices{"ours", "paper"}, "which one");
  }
};

std::string messageOf(const ConfigValues& values) {
  Example config;
  try {
    applyConfig(values, config);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Config, SetsFieldsAndKeepsTheDefaultsOfOthers) {
  Example config;
  EXPECT_TRUE(applyConfig({{"stride", 2}, {"distance", 1}, {"method", std::string("paper")}}, config).empty());
  EXPECT_EQ(config.stride, 2);
  EXPECT_EQ(config.distance, 1.0);
  EXPECT_EQ(config.method, "paper");
  EXPECT_TRUE(config.refine);
}

TEST(Config, SaysWhichKeyIsUnknownAndWhichWasMeant) {
  Example config;
  const auto warnings = applyConfig({{"strid", 2}}, config);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0], "unknown setting 'strid' is ignored; did you mean 'stride'?");
}

TEST(Config, RefusesValuesOutsideTheirRangeWithKeyValueAndRange) {
  EXPECT_EQ(messageOf({{"stride", 0}}), "setting 'stride' is 0 px, allowed is 1 to 32 px");
  EXPECT_EQ(messageOf({{"distance", std::numeric_limits<double>::quiet_NaN()}}),
            "setting 'distance' is not finite m, allowed is 0 to 1 m");
  EXPECT_EQ(messageOf({{"method", std::string("other")}}), "setting 'method' is 'other', allowed is one of 'ours', 'paper'");
}

TEST(Config, RefusesWrongTypes) {
  EXPECT_EQ(messageOf({{"stride", 2.5}}), "setting 'stride' is 2.5, expected a whole number");
  EXPECT_EQ(messageOf({{"refine", 1}}), "setting 'refine' is 1, expected true or false");
  EXPECT_EQ(messageOf({{"distance", std::string("far")}}), "setting 'distance' is 'far', expected a number");
}

TEST(Config, LeavesEverythingUnchangedWhenOneValueIsBad) {
  Example config;
  EXPECT_THROW(applyConfig({{"stride", 2}, {"distance", 5.0}}, config), ConfigError);
  EXPECT_EQ(config.stride, 4);
}

TEST(Config, ReadsBackWhatItPrints) {
  const std::string path = testing::TempDir() + "/config_test.yaml";
  Example written;
  written.stride = 7;
  written.distance = 0.1 + 0.2;
  std::ofstream(path) << toYaml(written, "Example");
  std::vector<std::string> warnings;
  const Example read = loadConfig<Example>(path, &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(read.stride, 7);
  EXPECT_EQ(read.distance, written.distance);
  std::remove(path.c_str());
}

TEST(Config, PrintsAHeadingAboveTheFirstFieldOfASection) {
  const std::string text = toYaml(Example(), "Example");
  const std::size_t heading = text.find("# ---- Which way.\n");
  ASSERT_NE(heading, std::string::npos) << text;
  EXPECT_GT(heading, text.find("refine: true"));
  EXPECT_LT(heading, text.find("# which one"));
  EXPECT_EQ(text.find("# ----", heading + 1), std::string::npos) << "one heading";
}

TEST(Config, PrintsNumbersThatEveryYamlReaderTakesForNumbers) {
  EXPECT_EQ(detail::yamlNumber(20), "20");
  EXPECT_EQ(detail::yamlNumber(1000000), "1000000");
  EXPECT_EQ(detail::yamlNumber(0.001), "0.001");
  EXPECT_EQ(detail::yamlNumber(1e-5), "1.0e-05");
  EXPECT_EQ(detail::yamlNumber(5e-324), "5.0e-324");
  EXPECT_EQ(detail::yamlNumber(0.1), "0.1");
}

TEST(Config, NamesTheFileThatCannotBeRead) {
  const auto refusal = [](const std::string& path) {
    std::vector<std::string> warnings;
    try {
      loadConfig<Example>(path, &warnings);
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal("/nowhere/planes.yaml"), "configuration file '/nowhere/planes.yaml' cannot be opened: there is no such file");
  EXPECT_EQ(refusal("/dev/zero"), "configuration file '/dev/zero' is a device, expected an ordinary file");
}

}  // namespace
}  // namespace cabinet_articulation::core
