// SPDX-License-Identifier: BSD-3-Clause
// ROS's program `nodelet`, as far as it runs nodelets itself, in a build with a sanitizer: that of ROS is not instrumented. All
// else is left to it (ROS_NODELET).
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <unistd.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command != "manager" && command != "standalone") {
    execv(ROS_NODELET, argv);
    std::perror(ROS_NODELET);
    return 1;
  }
  ros::init(argc, argv, command);
  const bool is_manager = command == "manager";
  // Never destroyed: if a bond breaks meanwhile, ~Loader unloads a nodelet from a list that is gone.
  static auto* const loader = new nodelet::Loader(is_manager);
  if (!is_manager && !loader->load(ros::this_node::getName(), argv[2], ros::names::getRemappings(), {})) return 1;
  ros::spin();
  for (const std::string& name : loader->listLoadedNodelets()) loader->unload(name);
  // As the last handle would, which the loader keeps.
  ros::shutdown();
  return 0;
}
