// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/input/watched_subscriber.h"

#include <sstream>

namespace cabinet_articulation {
namespace {

constexpr char kRaw[] = "raw";

/// Held while plugins are loaded, made or released: class_loader is not safe where several threads do so at once. It protects
/// stages from one another, not from foreign nodelets in their manager. Never destroyed, for subscribers may outlive it at exit.
std::mutex& plugins() {
  static auto* const mutex = new std::mutex;
  return *mutex;
}

}  // namespace

void requireInstalled(const ros::NodeHandle& nh, const std::string& transport) {
  if (transport == kRaw) return;
  const std::lock_guard<std::mutex> lock(plugins());
  // Never destroyed either: it keeps the libraries loaded while subscribers release their plugins.
  static auto* const transports = new image_transport::ImageTransport(nh);
  std::string installed;
  for (const std::string& plugin : transports->getLoadableTransports()) {
    const std::string name = plugin.substr(plugin.rfind('/') + 1);
    if (name == transport) return;
    installed += (installed.empty() ? "" : ", ") + name;
  }
  throw std::runtime_error("setting 'image_transport' is '" + transport + "', expected one that is installed: " + installed);
}

void WatchedSubscriber::subscribeImage(ros::NodeHandle& nh, const ros::NodeHandle& parameters, const std::string& topic,
                                       const std::string& transport, const CallbackGuard& guard,
                                       const Callback<sensor_msgs::Image>& callback) {
  // Without a plugin: class_loader is not safe where several threads make plugins at once.
  if (transport == kRaw) return subscribe<sensor_msgs::Image>(nh, topic, guard, callback);
  // Remapped here: image_transport appends the transport's name to the topic, and no remapping fits that.
  const std::string image = nh.resolveName(topic), resolved = image + "/" + transport;
  const std::lock_guard<std::mutex> lock(plugins());
  if (!transports_) transports_ = std::make_unique<image_transport::ImageTransport>(nh);
  // By default, plugins of all topics in a process have the same services and parameters.
  const image_transport::TransportHints hints(transport, ros::TransportHints().tcpNoDelay(), ros::NodeHandle(parameters, topic));
  set({{}, transports_->subscribe(image, kQueue, heard<sensor_msgs::Image>(resolved, guard, callback), ros::VoidPtr(), hints)});
}

WatchedSubscriber::~WatchedSubscriber() {
  if (!transports_) return;
  const std::lock_guard<std::mutex> lock(plugins());
  subscription_ = {};
  transports_.reset();
}

std::uint32_t WatchedSubscriber::publishers() const {
  const Subscription subscription = this->subscription();
  return subscription.messages.getNumPublishers() + subscription.images.getNumPublishers();
}

std::string WatchedSubscriber::silence(double patience) const {
  const double silent = ros::WallTime::now().toSec() - heard_;
  const Subscription subscription = this->subscription();
  if ((!subscription.messages && !subscription.images) || silent <= patience) return "";
  std::ostringstream text;
  text.precision(0);
  text << std::fixed << topic_ << ": nothing received for " << silent << " s, ";
  if (publishers() == 0)
    text << "nobody publishes it";
  else
    text << "although " << publishers() << (publishers() == 1 ? " publisher offers it" : " publishers offer it");
  return text.str();
}

}  // namespace cabinet_articulation
