// SPDX-License-Identifier: BSD-3-Clause
// A manager that dies comes back with its nodelets.
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <nodelet/NodeletList.h>
#include <ros/master.h>
#include <ros/network.h>
#include <xmlrpcpp/XmlRpc.h>

#include "support/ros_probe.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

const std::string kManager = "/cabinet/manager";

std::string uriOf(const std::string& node) {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  request[1] = node;
  return ros::master::execute("lookupNode", request, response, payload, false) ? std::string(payload) : "";
}

/// What a crash leaves behind is the same for everybody else: a node that is gone without a word to its loaders.
void end(const std::string& node) {
  std::string host;
  std::uint32_t port = 0;
  ASSERT_TRUE(ros::network::splitURI(uriOf(node), host, port));
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue request, response;
  request[0] = ros::this_node::getName();
  request[1] = "test";
  client.execute("shutdown", request, response);
}

size_t nodeletsLoaded() {
  nodelet::NodeletList list;
  return ros::service::call(kManager + "/list", list) ? list.response.nodelets.size() : 0;
}

TEST(Respawn, NodeletsAreLoadedAgainWhenTheManagerIsStartedAnew) {
  ros::NodeHandle nh;
  const Recorder<TrackArray> tracks("/cabinet/tracks");
  const ros::Publisher rectangles = nh.advertise<RectangleArray>("/cabinet/rectangles", 4);
  const auto works = [&] {
    RectangleArray message;
    message.header.frame_id = "camera";
    message.header.stamp = ros::Time::now();
    rectangles.publish(message);
    const size_t before = tracks.messages.size();
    return spinUntil([&] { return tracks.messages.size() > before; }, 0.2);
  };
  ASSERT_TRUE(spinUntil(works));
  ASSERT_TRUE(spinUntil([] { return nodeletsLoaded() == 2; })) << "tracking and articulation";
  const std::string before = uriOf(kManager);
  end(kManager);
  ASSERT_TRUE(spinUntil([&] { return uriOf(kManager) != before; }));
  EXPECT_TRUE(spinUntil([] { return nodeletsLoaded() == 2; }));
  EXPECT_TRUE(spinUntil(works));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "respawn_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
