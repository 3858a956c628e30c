// SPDX-License-Identifier: BSD-3-Clause
// One nodelet (NODELET_TYPE) as a node of its own, for debugging and for pipelines spread over computers.
#include <nodelet/loader.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, NODELET_NAME);
  nodelet::Loader loader;
  const nodelet::V_string arguments(argv + 1, argv + argc);
  if (!loader.load(ros::this_node::getName(), NODELET_TYPE, ros::names::getRemappings(), arguments)) return 1;
  ros::spin();
  return 0;
}
