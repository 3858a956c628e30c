// SPDX-License-Identifier: BSD-3-Clause
// load_nodelets MANAGER NAME[=TYPE]...: loads nodelets into a manager, loads them again when the manager was started anew,
// and unloads them at the end. TYPE is cabinet_articulation/NAME unless given; remappings are for all of them.
//
// One process for all: nodelet's own loader needs one for each, and each wakes up a hundred times a second. No bonds: with
// them a manager that is merely busy loses its nodelets.
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

namespace {

constexpr int kPeriod = 1;      // [s] between two looks at the manager
constexpr int kAfterError = 5;  // [s] until the next attempt

nodelet::NodeletLoad parse(const std::string& argument) {
  const size_t equals = argument.find('=');
  const std::string name = argument.substr(0, equals);
  nodelet::NodeletLoad load;
  constexpr bool kRemap = false;
  load.request.name = ros::names::resolve(name, kRemap);
  load.request.type =
      equals == std::string::npos ? "cabinet_articulation/" + name.substr(name.rfind('/') + 1) : argument.substr(equals + 1);
  for (const auto& [from, to] : ros::names::getRemappings()) {
    load.request.remap_source_args.push_back(from);
    load.request.remap_target_args.push_back(to);
  }
  return load;
}

class Loader {
 public:
  Loader(const std::string& manager, std::vector<nodelet::NodeletLoad> nodelets)
      : manager_(ros::names::resolve(manager)), nodelets_(std::move(nodelets)) {}

  /// False if some could not be loaded.
  bool load() {
    nodelet::NodeletList list;
    if (!call("/list", list)) return true;  // not there yet, or not any more
    const std::vector<std::string>& there = list.response.nodelets;
    bool all = true;
    for (nodelet::NodeletLoad& wanted : nodelets_) {
      const bool is_there = std::find(there.begin(), there.end(), wanted.request.name) != there.end();
      if (is_there && !is_first_) continue;
      if (is_there) unload(wanted);  // left by a loader that was killed, with settings of then
      ROS_INFO("loading %s into %s", wanted.request.name.c_str(), manager_.c_str());
      if (call("/load_nodelet", wanted)) continue;
      ROS_ERROR("%s cannot load %s of type %s", manager_.c_str(), wanted.request.name.c_str(), wanted.request.type.c_str());
      all = false;
    }
    is_first_ = false;
    return all;
  }

  void unload() {
    for (auto it = nodelets_.rbegin(); it != nodelets_.rend(); ++it) unload(*it);
  }

 private:
  /// Connects anew for each call: a connection that is kept can outlive its manager and still pass for a good one.
  template <class Service>
  bool call(const std::string& service, Service& call) {
    return ros::service::call(manager_ + service, call);
  }

  void unload(const nodelet::NodeletLoad& loaded) {
    nodelet::NodeletUnload request;
    request.request.name = loaded.request.name;
    call("/unload_nodelet", request);
  }

  ros::NodeHandle keep_alive_;
  const std::string manager_;
  std::vector<nodelet::NodeletLoad> nodelets_;
  bool is_first_ = true;
};

}  // namespace

int main(int argc, char** argv) {
  // Taken from the queue of signals below, so that the nodelets are unloaded while the node can still talk.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  ros::init(argc, argv, "load_nodelets", ros::init_options::NoSigintHandler);
  if (argc < 3) {
    std::fprintf(stderr, "usage: load_nodelets MANAGER NAME[=TYPE]... [TOPIC:=OTHER]...\n");
    return 2;
  }
  const auto on_rosnode_kill = [](XmlRpc::XmlRpcValue&, XmlRpc::XmlRpcValue& result) {
    ::kill(::getpid(), SIGTERM);
    result = ros::xmlrpc::responseInt(1, "", 0);
  };
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", on_rosnode_kill);
  std::vector<nodelet::NodeletLoad> nodelets;
  std::transform(argv + 2, argv + argc, std::back_inserter(nodelets), parse);
  Loader loader(argv[1], std::move(nodelets));
  timespec wait = {};
  do {
    wait.tv_sec = loader.load() ? kPeriod : kAfterError;
  } while (sigtimedwait(&signals, nullptr, &wait) < 0);
  loader.unload();
  return 0;
}
