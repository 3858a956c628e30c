// SPDX-License-Identifier: BSD-3-Clause
// Follows soak.launch for MINUTES of stamps, prints every minute what it costs and what is known, saves the models at the end,
// and judges. Exit status 0 when everything held; the last line says it in words.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SaveModels.h>
#include <cabinet_articulation/Timing.h>
#include <ros/callback_queue.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <xmlrpcpp/XmlRpc.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>

#include "cabinet_articulation/joints/model_file.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "ros/messages/simulation_conversions.h"
#include "tools/terminal/run_program.h"
#include "tools/truth/soak_record.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: soak_report _minutes:=M _file:=SAVED.yaml [_manager:=NODE] (remap truth, models, timing, predict, save_models)\n";
constexpr double kMinute = 60;    // [s]
constexpr double kPatience = 60;  // [s] of wall time without a result
constexpr std::uint32_t kQueue = 1000;

/// The process of a node on this computer.
int processOf(const std::string& node) {
  XmlRpc::XmlRpcValue request, response, payload;
  request[0] = ros::this_node::getName();
  request[1] = node;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::master::execute("lookupNode", request, response, payload, false) || !ros::network::splitURI(payload, host, port))
    throw std::runtime_error("there is no node " + node);
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpc::XmlRpcValue answer;
  request.setSize(1);
  if (!client.execute("getPid", request, answer)) throw std::runtime_error(node + " does not answer");
  return static_cast<int>(answer[2]);
}

double residentMegabytes(int process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmRSS:", 0) == 0) return std::stod(line.substr(6)) / 1024;
  throw std::runtime_error("the manager is gone (process " + std::to_string(process) + ")");
}

class SoakReport {
 public:
  SoakReport() : private_("~") {
    private_.param("minutes", minutes_, 0.0);
    private_.param<std::string>("file", file_, "");
    private_.param<std::string>("manager", manager_, "/cabinet/manager");
    if (!(minutes_ > 0)) throw std::invalid_argument("'minutes' is missing, expected a number above 0");
    if (!std::filesystem::path(file_).is_absolute() || std::filesystem::exists(file_))
      throw std::invalid_argument("'file' is '" + file_ + "', expected the absolute path of a file that does not exist yet");
    truth_ = node_.subscribe("truth", kQueue, &SoakReport::onTruth, this);
    models_ = node_.subscribe("models", kQueue, &SoakReport::onModels, this);
    timing_ = node_.subscribe("timing", kQueue, &SoakReport::onTiming, this);
  }

  int run() {
    std::printf("%s\n", SoakRecord::heading().c_str());
    for (heard_ = ros::WallTime::now(); ros::ok() && time_ < minutes_ * kMinute;) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
      if ((ros::WallTime::now() - heard_).toSec() > kPatience)
        throw std::runtime_error("failed: no models for " + std::to_string(static_cast<int>(kPatience)) +
                                 " s of wall time, after " + std::to_string(frames_) + " frames");
    }
    if (!ros::ok()) throw std::runtime_error("failed: ended from outside after " + std::to_string(frames_) + " frames");
    const std::vector<Judgement> judgements = record_.judge(time_, save(), SoakLimits());
    std::printf("\n%d frames in %.1f minutes of stamps and %.1f of wall time\n%s", frames_, time_ / kMinute,
                (ros::WallTime::now() - start_).toSec() / kMinute, format(judgements).c_str());
    return allHeld(judgements) ? 0 : 1;
  }

 private:
  /// What is known of one frame so far; its messages may come in any order.
  struct Frame {
    SceneTruth::ConstPtr truth;
    ros::WallTime shown;
    ArticulationModelArray::ConstPtr models;
    ros::WallTime answered;
  };

  void onTruth(const SceneTruth::ConstPtr& truth) {
    Frame& frame = frames_in_work_[truth->header.stamp];
    frame.truth = truth;
    frame.shown = ros::WallTime::now();
    if (frame.models) finish(truth->header.stamp);
  }

  void onModels(const ArticulationModelArray::ConstPtr& models) {
    Frame& frame = frames_in_work_[models->header.stamp];
    frame.models = models;
    frame.answered = ros::WallTime::now();
    if (frame.truth) finish(models->header.stamp);
  }

  void onTiming(const Timing::ConstPtr& timing) {
    if (frames_ > 0) record_.addStage(secondsBetween(first_stamp_, timing->header.stamp), timing->stage, timing->milliseconds);
  }

  void finish(const ros::Time& stamp) {
    if (frames_ == 0) {
      first_stamp_ = stamp;
      start_ = ros::WallTime::now();
      process_ = processOf(manager_);
    }
    for (auto it = frames_in_work_.begin(); it->first < stamp; it = frames_in_work_.erase(it))
      if (frames_ > 0 && it->second.truth)
        record_.addLostFrame(secondsBetween(first_stamp_, it->first), inFrame(*it->second.truth, frame_id_));
    const Frame frame = frames_in_work_.extract(stamp).mapped();
    frame_id_ = frame.models->header.frame_id;
    heard_ = ros::WallTime::now();
    const double time = secondsBetween(first_stamp_, stamp);
    record_.addFrame(time, frame.answered.toSec(), inFrame(*frame.truth, frame_id_), fromMessage(*frame.models));
    record_.addLatency(time, 1e3 * (frame.answered - frame.shown).toSec());
    if (static_cast<int>(time) > static_cast<int>(time_) || frames_ == 0) record_.addMemory(time, residentMegabytes(process_));
    if (time >= next_line_ || time >= minutes_ * kMinute) {
      std::printf("%s\n", record_.minute(next_line_ - kMinute, time).c_str());
      std::fflush(stdout);
      next_line_ += kMinute;
    }
    time_ = time;
    ++frames_;
  }

  static bool isRemembered(std::uint32_t id) {
    Predict call;
    call.request.id = id;
    call.request.q = {0};
    return ros::service::call(ros::names::resolve("predict"), call) && call.response.success;
  }

  /// Lets the pipeline save what it learned, and reads it.
  std::vector<core::LearnedModel> save() {
    SaveModels call;
    call.request.file = file_;
    if (!ros::service::call(ros::names::resolve("save_models"), call))
      throw std::runtime_error("failed: save_models did not answer");
    if (!call.response.success) throw std::runtime_error("failed: save_models: " + call.response.message);
    std::vector<core::LearnedModel> models;
    for (const core::KnownFront& front : core::readModelFile(file_).fronts) models.push_back(front.model);
    return models;
  }

  ros::NodeHandle node_, private_;
  ros::Subscriber truth_, models_, timing_;
  double minutes_ = 0;
  std::string file_, manager_;

  SoakRecord record_{isRemembered};
  std::map<ros::Time, Frame> frames_in_work_;
  std::string frame_id_;
  ros::Time first_stamp_;
  ros::WallTime start_, heard_;
  int process_ = 0, frames_ = 0;
  double time_ = 0, next_line_ = kMinute;  ///< [s] since the first frame
};

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  ros::init(argc, argv, "soak_report");
  return cabinet_articulation::runProgram("soak_report", cabinet_articulation::kUsage,
                                          [] { return cabinet_articulation::SoakReport().run(); });
}
