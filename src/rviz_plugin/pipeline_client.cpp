// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/pipeline_client.h"

#include <cabinet_articulation/ArticulationModelArray.h>
#include <ros/connection.h>
#include <ros/service_manager.h>

#include <algorithm>

namespace cabinet_articulation {
namespace {

constexpr std::chrono::seconds kPatience{10};  ///< ours: a pipeline answers between two frames, within a second or so
constexpr int kWatchPeriod = 200;              ///< [ms] ours

/// Ends the wait in ServiceServerLink::call(), which is safe in any thread. ros::ServiceClient cannot do so: its shutdown()
/// leaves a call alone whose connection is made for that call.
void breakOff(const ros::ServiceServerLinkPtr& connection) { connection->getConnection()->drop(ros::Connection::Destructing); }

}  // namespace

PipelineClient::PipelineClient() : worker_([this] { work(); }) {
  connect(&watch_, &QTimer::timeout, this, &PipelineClient::breakOffLateCall);
  watch_.start(kWatchPeriod);
}

PipelineClient::~PipelineClient() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
    if (calling_) breakOff(calling_);
  }
  came_.notify_all();
  worker_.join();
}

void PipelineClient::enqueue(const std::string& key, Work work) {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    const auto same = std::find_if(waiting_.begin(), waiting_.end(), [&](const auto& other) { return other.first == key; });
    if (same == waiting_.end()) {
      waiting_.emplace_back(key, std::move(work));
    } else {
      same->second = std::move(work);
    }
  }
  came_.notify_all();
}

void PipelineClient::work() {
  for (;;) {
    Work next;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      came_.wait(lock, [this] { return over_ || !waiting_.empty(); });
      if (over_) return;
      next = std::move(waiting_.front().second);
      waiting_.pop_front();
    }
    next();
  }
}

std::string PipelineClient::exchange(const std::string& name, const std::string& md5sum, const ros::SerializedMessage& request,
                                     ros::SerializedMessage* answer) {
  if (!ros::service::exists(name, false)) return name + " is not there: is the pipeline running in this namespace?";
  const ros::ServiceServerLinkPtr connection =
      ros::ServiceManager::instance()->createServiceServerLink(name, false, md5sum, md5sum, {});
  bool answered = false;
  if (connection && begin(connection)) {
    answered = connection->call(request, *answer);
    if (!end())
      return name + " gave no answer within " + std::to_string(kPatience.count()) + " s: the pipeline is busy, or hangs";
  }
  return answered ? "" : name + " did not answer: the pipeline ended or refused the request";
}

bool PipelineClient::begin(const ros::ServiceServerLinkPtr& connection) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (over_) return false;
  calling_ = connection;
  deadline_ = std::chrono::steady_clock::now() + kPatience;
  late_ = false;
  return true;
}

bool PipelineClient::end() {
  std::lock_guard<std::mutex> lock(mutex_);
  calling_.reset();
  return !late_;
}

void PipelineClient::breakOffLateCall() {
  std::lock_guard<std::mutex> lock(mutex_);
  if (!calling_ || std::chrono::steady_clock::now() < deadline_) return;
  late_ = true;
  breakOff(calling_);
}

void PipelineClient::findNamespaces(const std::function<void(const std::vector<std::string>&)>& answered) {
  enqueue("namespaces", [this, answered] {
    ros::master::V_TopicInfo topics;
    if (!ros::master::getTopics(topics)) return;
    std::vector<std::string> found;
    for (const ros::master::TopicInfo& topic : topics)
      if (topic.datatype == ros::message_traits::datatype<ArticulationModelArray>())
        found.push_back(ros::names::parentNamespace(topic.name));
    QMetaObject::invokeMethod(
        this, [answered, found] { answered(found); }, Qt::QueuedConnection);
  });
}

}  // namespace cabinet_articulation
