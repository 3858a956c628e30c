// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>

#include <algorithm>

#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::spinUntil;

/// Loads nodelets with settings from parameters.test.
class Parameters : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(ros::service::waitForService("/manager/load_nodelet", ros::Duration(test::kGenerous)));
    // What is logged before the connection stands is lost.
    ASSERT_TRUE(spinUntil([&] { return reports_.hears(2); }));
  }

  void load(const std::string& name, const std::string& stage = "stereo") {
    nodelet::NodeletLoad call;
    call.request.name = "/" + name;
    call.request.type = "cabinet_articulation/" + stage;
    ASSERT_TRUE(ros::service::call("/manager/load_nodelet", call));
    ASSERT_TRUE(call.response.success);
  }

  void expectRefusal(const std::string& name, const std::string& text) {
    load(name);
    EXPECT_TRUE(spinUntil([&] { return reports_.logged(rosgraph_msgs::Log::FATAL, text); }));
    EXPECT_TRUE(spinUntil([&] { return reports_.status(name) == "not running: " + text; })) << reports_.status(name);
  }

  test::Reports reports_;
};

TEST_F(Parameters, OutOfRangeIsRefusedWithParameterValueAndRange) {
  expectRefusal("out_of_range", "/out_of_range: setting 'texture_threshold' is -5, allowed is 0 to 10000");
}

TEST_F(Parameters, WrongTypeIsRefused) {
  expectRefusal("wrong_type", "/wrong_type: setting 'correlation_window_size' is 'large', expected a whole number");
}

TEST_F(Parameters, WhatTheStageItselfRefusesIsToldWithTheNodeletsName) {
  load("even_window");
  EXPECT_TRUE(spinUntil([&] { return reports_.statusHas("even_window", "not running: /even_window: "); }));
  EXPECT_TRUE(reports_.statusHas("even_window", "correlation_window_size")) << reports_.status("even_window");
}

TEST_F(Parameters, AnImageTransportThatIsNotInstalledIsRefusedWithThoseThatAre) {
  for (const char* stage : {"stereo", "planes", "rectangles", "overlay"}) {
    const std::string name = std::string("transport/") + stage;
    load(name, stage);
    const auto says = [&](const char* text) { return reports_.statusHas(name, text); };
    EXPECT_TRUE(spinUntil([&] {
      return says("not running: ") && says("setting 'image_transport' is 'pigeon', expected one that is installed: ") &&
             says("raw");
    })) << reports_.status(name);
  }
}

TEST_F(Parameters, RectanglesRefinesPlanesBySettingsOfThePlanesStageBesideIt) {
  load("beside/rectangles", "rectangles");
  EXPECT_TRUE(spinUntil([&] { return reports_.statusHas("beside/rectangles", "not running: "); }));
  EXPECT_TRUE(reports_.statusHas("beside/rectangles", "/beside/planes: setting 'refine_pixels' is 5, allowed is 100 to"))
      << reports_.status("beside/rectangles");
}

TEST_F(Parameters, MisspeltNameIsAWarningWithTheRightOne) {
  load("misspelt");
  EXPECT_TRUE(spinUntil([&] {
    return reports_.logged(rosgraph_msgs::Log::WARN,
                           "unknown setting 'disparity_rnage' is ignored; did you mean 'disparity_range'?");
  }));
  EXPECT_TRUE(spinUntil([&] { return reports_.statusHas("misspelt", "idle"); })) << "it runs all the same";
}

TEST_F(Parameters, ManagerLivesOnAfterRefusals) {
  load("well");
  EXPECT_TRUE(spinUntil([&] { return reports_.statusHas("well", "idle"); }));
  nodelet::NodeletList list;
  ASSERT_TRUE(ros::service::call("/manager/list", list));
  EXPECT_NE(std::find(list.response.nodelets.begin(), list.response.nodelets.end(), "/well"), list.response.nodelets.end());
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "parameters_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
