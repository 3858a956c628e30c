// SPDX-License-Identifier: BSD-3-Clause
// Every nodelet is unloaded in the middle of its work, leaves nothing behind, and works again when it is loaded again.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/SceneTruth.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <ros/master.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "support/pipeline_nodelets.h"
#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::kNodelets;
using test::loadNodelet;
using test::Recorder;
using test::spinUntil;
using test::unloadNodelet;

/// What the manager has at the master: "publishes /topic", "subscribes /topic", "offers /service".
std::set<std::string> registered() {
  XmlRpc::XmlRpcValue request, response, state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false)) return {};
  const char* kinds[] = {"publishes ", "subscribes ", "offers "};
  std::set<std::string> names;
  for (int kind = 0; kind < 3; ++kind)
    for (int i = 0; i < state[kind].size(); ++i)
      for (int j = 0; j < state[kind][i][1].size(); ++j)
        if (std::string(state[kind][i][1][j]) == "/manager") names.insert(kinds[kind] + std::string(state[kind][i][0]));
  return names;
}

std::string list(const std::set<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += name + "\n";
  return text;
}

std::set<std::string> without(const std::set<std::string>& all, const std::set<std::string>& some) {
  std::set<std::string> rest;
  std::set_difference(all.begin(), all.end(), some.begin(), some.end(), std::inserter(rest, rest.end()));
  return rest;
}

TEST(Reload, EveryNodeletComesAndGoesWithoutATrace) {
  // The last that a manager offers.
  ASSERT_TRUE(ros::service::waitForService("/manager/list", ros::Duration(test::kGenerous)));
  const std::set<std::string> empty = registered();
  Recorder<ArticulationModelArray> models("/cabinet/models");
  Recorder<sensor_msgs::Image> overlays("/cabinet/overlay");
  const auto works = [&] {
    models.messages.clear();
    overlays.messages.clear();
    return spinUntil([&] { return models.messages.size() > 2 && overlays.messages.size() > 2; });
  };
  for (const std::string& name : kNodelets) ASSERT_TRUE(loadNodelet(name)) << name;
  ASSERT_TRUE(works());
  const std::set<std::string> full = registered();

  for (const std::string& name : kNodelets) {
    ASSERT_TRUE(unloadNodelet(name)) << name;
    for (const std::string& left : registered())
      EXPECT_EQ(left.find(' ' + name + '/'), std::string::npos) << left << " after " << name << " was unloaded";
    ASSERT_TRUE(loadNodelet(name)) << name;
    EXPECT_TRUE(works()) << "after " << name << " was loaded again";
    EXPECT_TRUE(spinUntil([&] { return registered() == full; })) << name << "\nmissing:\n"
                                                                 << list(without(full, registered())) << "too many:\n"
                                                                 << list(without(registered(), full));
  }

  // In the order of the pipeline: each is unloaded while the next one still listens.
  for (const std::string& name : kNodelets) ASSERT_TRUE(unloadNodelet(name)) << name;
  EXPECT_TRUE(spinUntil([&] { return registered() == empty; })) << list(without(registered(), empty));
  nodelet::NodeletList loaded;
  ASSERT_TRUE(ros::service::call("/manager/list", loaded)) << "the manager lives on";
  EXPECT_TRUE(loaded.response.nodelets.empty());
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "reload_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
