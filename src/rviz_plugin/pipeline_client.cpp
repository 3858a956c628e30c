// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/pipeline_client.h"

#include <cabinet_articulation/ArticulationModelArray.h>

#include <algorithm>

namespace cabinet_articulation {

PipelineClient::~PipelineClient() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    over_ = true;
    calling_.shutdown();
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

bool PipelineClient::begin(const ros::ServiceClient& client) {
  std::lock_guard<std::mutex> lock(mutex_);
  calling_ = client;
  return !over_;
}

void PipelineClient::end() {
  std::lock_guard<std::mutex> lock(mutex_);
  calling_ = ros::ServiceClient();
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
