// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/ros.h>

#include <QObject>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace cabinet_articulation {

/// Calls a pipeline's services in a thread of its own: a pipeline that is busy, or gone, does not hold up RViz. Answers come in
/// the thread of this object, and not at all once it is gone.
class PipelineClient : public QObject {
 public:
  PipelineClient() : worker_([this] { work(); }) {}
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
    call->response.success = false;
    if (!ros::service::exists(name, false)) {
      call->response.message = name + " is not there: is the pipeline running in this namespace?";
      return;
    }
    ros::ServiceClient client = ros::NodeHandle().serviceClient<Service>(name);
    if (!begin(client)) return;
    if (!client.call(*call)) call->response.message = name + " did not answer: the pipeline ended or refused the request";
    end();
  }

  /// Between these the destructor can break off a call. False when all is over already.
  bool begin(const ros::ServiceClient& client);
  void end();

  std::mutex mutex_;  ///< guards all but the thread
  std::condition_variable came_;
  std::deque<std::pair<std::string, Work>> waiting_;
  ros::ServiceClient calling_;
  bool over_ = false;
  std::thread worker_;  ///< last: it uses all of these
};

}  // namespace cabinet_articulation
