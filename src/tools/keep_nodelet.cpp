// SPDX-License-Identifier: BSD-3-Clause
// keep_nodelet load TYPE MANAGER: as `nodelet load TYPE MANAGER --no-bond`, but loads the nodelet again when the manager
// was started anew. (nodelet's own loader without a bond never notices; with a bond, a manager that is merely busy loses
// its nodelets.)
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>

namespace {

constexpr double kPeriod = 1;  // [s] between two looks at the manager

volatile std::sig_atomic_t stopping = 0;

class Keeper {
 public:
  Keeper(const std::string& type, const std::string& manager)
      : manager_(ros::names::resolve(manager)),
        list_(nh_.serviceClient<nodelet::NodeletList>(manager_ + "/list")),
        load_(nh_.serviceClient<nodelet::NodeletLoad>(manager_ + "/load_nodelet")),
        unload_(nh_.serviceClient<nodelet::NodeletUnload>(manager_ + "/unload_nodelet")) {
    request_.request.name = ros::this_node::getName();
    request_.request.type = type;
    for (const auto& remapping : ros::names::getRemappings()) {
      request_.request.remap_source_args.push_back(remapping.first);
      request_.request.remap_target_args.push_back(remapping.second);
    }
  }

  void keepLoaded() {
    while (!stopping && ros::ok()) {
      nodelet::NodeletList loaded;
      if (list_.call(loaded) && !contains(loaded.response.nodelets)) load();
      for (int i = 0; i < 10 && !stopping; ++i) ros::WallDuration(kPeriod / 10).sleep();
    }
    nodelet::NodeletUnload request;
    request.request.name = request_.request.name;
    unload_.call(request);
  }

 private:
  bool contains(const std::vector<std::string>& nodelets) const {
    return std::find(nodelets.begin(), nodelets.end(), request_.request.name) != nodelets.end();
  }

  void load() {
    ROS_INFO("loading %s into %s", request_.request.type.c_str(), manager_.c_str());
    if (!load_.call(request_)) ROS_ERROR_THROTTLE(10, "%s could not load %s", manager_.c_str(), request_.request.type.c_str());
  }

  ros::NodeHandle nh_;
  const std::string manager_;
  ros::ServiceClient list_, load_, unload_;
  nodelet::NodeletLoad request_;
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "keep_nodelet", ros::init_options::NoSigintHandler);
  if (argc != 4 || std::string(argv[1]) != "load") {
    std::fprintf(stderr, "usage: keep_nodelet load TYPE MANAGER\n");
    return 2;
  }
  // The nodelet is unloaded while the node can still talk.
  const auto stop = [](int) { stopping = 1; };
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  Keeper(argv[2], argv[3]).keepLoaded();
  return 0;
}
