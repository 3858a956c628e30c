// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>
#include <ros/service_server_link.h>

#include <QObject>
#include <QTimer>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace cabinet_articulation {

/// Calls a pipeline's services in a thread of its own: a pipeline that is busy, or gone, does not hold up RViz. Answers come in
/// the thread of this object, and not at all once it is gone. A call without an answer ends after ten seconds, or with this
/// object.
class PipelineClient : public QObject {
 public:
  PipelineClient();
  ~PipelineClient() override;

  /// Calls `service`, an absolute name. Where it cannot be reached, the answer has success = false and says why. A request that
  /// still waits is replaced by a newer one of the same `key`, so that a slider never runs ahead of its answers.
  template <class Service, class Answered>
  void ask(const std::string& key, const std::string& service, Service call, Answered answered) {
    enqueue(key, [this, service, call = std::move(call), answered]() mutable {
      reach(service, &call);
      QMetaObject::invokeMethod(
          this, [answered, call] { answered(call); }, Qt::QueuedConnection);
    });
  }

  /// Looks for namespaces that publish models; answers as ask() does.
  void findNamespaces(const std::function<void(const std::vector<std::string>&)>& answered);

 private:
  using Work = std::function<void()>;

  void enqueue(const std::string& key, Work work);
  void work();

  template <class Service>
  void reach(const std::string& name, Service* call) {
    namespace serialization = ros::serialization;
    call->response.success = false;
    ros::SerializedMessage answer;
    call->response.message =
        exchange(name, ros::service_traits::md5sum<Service>(), serialization::serializeMessage(call->request), &answer);
    if (!call->response.message.empty()) return;
    try {
      serialization::deserializeMessage(answer, call->response);
    } catch (const ros::serialization::StreamOverrunException& error) {
      call->response.message = name + " sent an answer that cannot be read: " + error.what();
    }
  }

  /// Returns in words why there is no answer; empty if there is one.
  std::string exchange(const std::string& name, const std::string& md5sum, const ros::SerializedMessage& request,
                       ros::SerializedMessage* answer);

  /// Between these a call can be broken off. begin() is false when all is over already, end() when the call took too long.
  bool begin(const ros::ServiceServerLinkPtr& connection);
  bool end();

  void breakOffLateCall();

  std::mutex mutex_;  ///< guards all but the thread and the timer
  std::condition_variable came_;
  std::deque<std::pair<std::string, Work>> waiting_;
  ros::ServiceServerLinkPtr calling_;
  std::chrono::steady_clock::time_point deadline_;
  bool late_ = false, over_ = false;
  QTimer watch_;
  std::thread worker_;  ///< last: it uses all of these
};

}  // namespace cabinet_articulation
