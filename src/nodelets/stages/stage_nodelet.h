// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <std_msgs/Header.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "nodelets/input/watched_subscriber.h"
#include "nodelets/running/callback_threads.h"
#include "nodelets/running/latest_worker.h"
#include "nodelets/running/settings.h"
#include "nodelets/running/stage_health.h"
#include "ros/checks/callback_guard.h"
#include "ros/settings/live_settings.h"
#include "ros/settings/parameters.h"

namespace cabinet_articulation {

/// How long a frame waited for what another stage knows, before its turn.
struct StageWait {
  double seconds = 0;
  bool in_vain = false;  ///< it did not come in time
};

/*
 * What all stages have in common at the ROS edge: settings that are checked before anything starts, inputs that are
 * subscribed to only while somebody listens to the outputs, a worker that does the stage's work, `timing`, and the state in
 * words on /diagnostics.
 *
 * Whatever ROS calls (inputs, connections, the timer) and the worker's jobs go through one guard, which turns an exception into
 * a trouble: nothing escapes into the manager.
 *
 * Callbacks run in a thread of the stage's own, one after the other, once it has started.
 *
 * A stage with bad settings says so (log and diagnostics) and stays inert; the manager and the other stages live on.
 * A stage cannot be exported but as EndsInOrder<Stage>, which ends callbacks and worker before a member is destroyed.
 */
class StageNodelet : public nodelet::Nodelet {
 protected:
  explicit StageNodelet(const std::string& stage) : stage_(stage) {}

  /// Loads the settings, builds the stage and advertises. Throws to refuse.
  virtual void start() = 0;
  virtual void subscribe() = 0;
  virtual void unsubscribe() = 0;

  /// The stage ends: a job that waits for something goes on now, and no later one waits. Not called by the worker.
  virtual void interrupt() {}

  /// The last act of a stage, started or refused: its inputs and its worker have ended, its members are all still there.
  virtual void finish() {}

  template <class... Configs>
  void loadSettings(Configs&... configs) {
    for (const std::string& warning : loadParameters(getPrivateNodeHandle(), settings_, configs...))
      NODELET_WARN("%s: %s", getName().c_str(), warning.c_str());
  }

  /// Lets rqt_reconfigure change the settings of the stage. `apply` builds the stage anew, between two frames; it throws to
  /// refuse.
  template <class Config>
  void offerTuning(const Config& config, const std::function<void(const Config&)>& apply) {
    const auto tuned = std::make_shared<Config>(config);
    const auto set = [this, tuned, apply](const core::ConfigValues& values) {
      std::lock_guard<std::mutex> lock(working_);
      Config changed = *tuned;
      core::applyConfig(values, changed);
      apply(changed);
      *tuned = changed;
      return toTuning(changed);
    };
    live_settings_ =
        std::make_unique<LiveSettings>(getPrivateNodeHandle(), describeForTuning<Config>(), toTuning(config), set, guard_);
  }

  /// An output whose subscribers make the stage work. `greet` tells a new subscriber what it missed.
  template <class Message>
  ros::Publisher advertise(const std::string& topic, const ros::SubscriberStatusCallback& greet = {}) {
    const auto follow = [this, topic](const ros::SingleSubscriberPublisher&) { guard_(topic, [this] { followListeners(); }); };
    const auto came = [this, topic, greet, follow](const ros::SingleSubscriberPublisher& subscriber) {
      if (greet) guard_(topic, [&] { greet(subscriber); });
      follow(subscriber);
    };
    outputs_.push_back(getNodeHandle().advertise<Message>(topic, kOutputQueue, came, follow));
    return outputs_.back();
  }

  /// Publishes a message that nobody touches afterwards: subscribers in this process get this very object.
  template <class Message>
  void publish(const ros::Publisher& output, const boost::shared_ptr<Message>& message) {
    NODELET_DEBUG_STREAM_NAMED("zero_copy", output.getTopic() << " published at " << message.get());
    output.publish(message);
  }

  template <class Message>
  void publish(const ros::Publisher& output, Message message) {
    publish(output, boost::make_shared<Message>(std::move(message)));
  }

  /// Lets the worker, a thread of the stage's own, do this job. One that still waits is dropped for it, and counted.
  void workOnNewest(LatestWorker::Job job);

  /// The same for a job that works on all that has come by then, so that nothing is lost with one that is replaced.
  void workOnAll(LatestWorker::Job job) { worker_.put(guarded(std::move(job))); }

  /// Runs the stage on one frame, measures it and turns an exception into a trouble. Called by the job.
  void runStage(const std_msgs::Header& header, const std::function<void()>& work, const StageWait& wait = {});

  /// An input without which the stage stands still: its silence is a trouble.
  void require(const WatchedSubscriber* input) { required_.push_back(input); }

  void trouble(const std::string& key, const std::string& text);

  /// For inputs: turns what their callbacks throw into troubles.
  const CallbackGuard& guard() const { return guard_; }

  StageHealth& health() { return health_; }

 private:
  template <class Stage>
  friend class EndsInOrder;

  static constexpr std::uint32_t kOutputQueue = 4;

  /// Keeps a stage abstract until EndsInOrder makes it whole.
  virtual void endsInOrder() = 0;
  void stop();

  void onInit() override;
  void refuse(const std::string& reason);
  void followListeners();
  void diagnose();
  void initialize();
  LatestWorker::Job guarded(LatestWorker::Job job) const;

  CallbackThreads callbacks_;  ///< outlives all that has callbacks, publishers too
  const std::string stage_;
  StageSettings settings_;
  StageHealth health_;
  const CallbackGuard guard_{[this](const std::string& where, const std::string& what) { trouble(where, what); }};
  std::vector<const WatchedSubscriber*> required_;

  std::mutex working_;  ///< held while a frame is worked on or the stage is built anew
  std::unique_ptr<LiveSettings> live_settings_;

  std::mutex mutex_;  ///< guards the four below; held while subscribing and unsubscribing
  bool started_ = false;
  bool subscribed_ = false;
  ros::Time last_diagnosed_;
  std::vector<ros::Publisher> outputs_;

  ros::Publisher timing_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::WallTimer timer_;
  LatestWorker worker_;
};

/// A stage as it is exported. Its destructor is the first to run, so whatever a callback or a job uses is still there.
template <class Stage>
class EndsInOrder final : public Stage {
 public:
  using Stage::Stage;
  ~EndsInOrder() override { this->stop(); }

 private:
  void endsInOrder() override {}
};

}  // namespace cabinet_articulation
