// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/stages/stage_nodelet.h"

#include <cabinet_articulation/Timing.h>

#include <chrono>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "nodelets/running/orderly_exit.h"

namespace cabinet_articulation {
namespace {

constexpr double kPatience = 3;  ///< [s] of silence before a missing topic is a trouble

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

void StageNodelet::onInit() {
  getNodeHandle().setCallbackQueue(callbacks_.queue());
  getPrivateNodeHandle().setCallbackQueue(callbacks_.queue());
  guard_("start", [this] { initialize(); });
  callbacks_.start(1);
}

void StageNodelet::initialize() {
  endOnSigtermAsOnSigint();
  ros::NodeHandle& nh = getNodeHandle();
  updater_ = std::make_unique<diagnostic_updater::Updater>(nh, getPrivateNodeHandle(), getName());
  updater_->setHardwareID("none");
  updater_->add(stage_, [this](diagnostic_updater::DiagnosticStatusWrapper& status) { health_.describe(now(), &status); });
  timing_ = nh.advertise<Timing>("timing", kOutputQueue);
  try {
    std::lock_guard<std::mutex> lock(mutex_);
    start();
    started_ = true;
  } catch (const std::exception& error) {
    refuse(error.what());
  }
  timer_ = nh.createWallTimer(ros::WallDuration(settings_.diagnostic_period),
                              [this](const ros::WallTimerEvent&) { guard_("diagnostics", [this] { diagnose(); }); });
  followListeners();
}

void StageNodelet::refuse(const std::string& reason) {
  const std::string text = reason.rfind(getName(), 0) == 0 ? reason : getName() + ": " + reason;
  NODELET_FATAL("%s", text.c_str());
  health_.refuse(text);
}

void StageNodelet::stop() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    started_ = false;
  }
  interrupt();
  callbacks_.stop();
  if (live_settings_) live_settings_->shutdown();
  timer_.stop();
  unsubscribe();
  worker_.stop();
  // After the worker: nobody may publish to an output that is shut down.
  for (ros::Publisher& output : outputs_) output.shutdown();
  finish();
}

void StageNodelet::workOnNewest(LatestWorker::Job job) {
  if (worker_.put(guarded(std::move(job)))) health_.dropped();
}

LatestWorker::Job StageNodelet::guarded(LatestWorker::Job job) const {
  return [this, job = std::move(job)] { guard_("worker", job); };
}

void StageNodelet::followListeners() {
  std::lock_guard<std::mutex> lock(mutex_);
  if (!started_) return;
  bool wanted = !settings_.lazy;
  for (const ros::Publisher& output : outputs_) wanted = wanted || output.getNumSubscribers() > 0;
  if (wanted == subscribed_) return;
  subscribed_ = wanted;
  health_.setActive(wanted, now());
  wanted ? subscribe() : unsubscribe();
}

void StageNodelet::runStage(const std_msgs::Header& header, const std::function<void()>& work, const StageWait& wait) {
  std::lock_guard<std::mutex> lock(working_);
  const double start = now();
  try {
    work();
  } catch (const std::exception& error) {
    trouble("input", error.what());
    return;
  }
  Timing timing;
  timing.header = header;
  timing.stage = stage_;
  timing.milliseconds = 1e3 * (now() - start);
  timing.waited = 1e3 * wait.seconds;
  timing.incomplete = wait.in_vain;
  health_.processed(secondsBetween(header.stamp, ros::Time::now()), timing.milliseconds, now());
  publish(timing_, std::move(timing));
}

void StageNodelet::trouble(const std::string& key, const std::string& text) {
  if (health_.trouble(key, text, now())) NODELET_WARN("%s: %s", getName().c_str(), text.c_str());
}

void StageNodelet::diagnose() {
  {
    std::lock_guard<std::mutex> lock(mutex_);
    const ros::Time time = ros::Time::now();
    const bool paused = ros::Time::isSimTime() && time == last_diagnosed_;
    last_diagnosed_ = time;
    health_.setPaused(paused, now());
    if (subscribed_ && !paused)
      for (const WatchedSubscriber* input : required_) {
        const std::string silence = input->silence(kPatience);
        if (!silence.empty()) trouble("missing " + input->topic(), silence);
      }
  }
  updater_->force_update();
}

}  // namespace cabinet_articulation
