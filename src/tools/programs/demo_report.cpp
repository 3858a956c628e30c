// SPDX-License-Identifier: BSD-3-Clause
// Follows a simulated scene to the end of its script, prints each learned object beside the truth, writes the overlay
// of the moment with the fronts farthest open, and exits with 0 when the models are right.
#include <cv_bridge/cv_bridge.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>

#include "ros/messages/simulation_conversions.h"
#include "tools/truth/truth_comparison.h"

namespace cabinet_articulation {
namespace {

class DemoReport {
 public:
  DemoReport() : node_(), private_("~") {
    private_.param("timeout", timeout_, 120.0);
    private_.param("settle", settle_, 3.0);
    private_.param<std::string>("picture", picture_, "");
    truth_subscriber_ = node_.subscribe("truth", 100, &DemoReport::onTruth, this);
    models_subscriber_ = node_.subscribe("models", 10, &DemoReport::onModels, this);
    if (!picture_.empty()) overlay_subscriber_ = node_.subscribe("overlay", 2, &DemoReport::onOverlay, this);
  }

  int run() {
    ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(timeout_);
    bool ended = false;
    while (ros::ok() && ros::WallTime::now() < deadline) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(0.1));
      if (ended || !script_ended_) continue;
      // The newest models may still be on their way through the pipeline.
      ended = true;
      deadline = ros::WallTime::now() + ros::WallDuration(settle_);
    }
    if (!ended) {
      std::printf("no end of the script within %.0f s: %d frames of truth and %d model messages came\n", timeout_,
                  static_cast<int>(truths_.size()), model_messages_);
      return 1;
    }
    const SceneComparison comparison = compare();
    std::printf("\nscene '%s': %d frames, %d model messages, %zu live objects\n\n%s", scene_.c_str(),
                static_cast<int>(truths_.size()), model_messages_, models_.models.size(), format(comparison).c_str());
    if (!picture_.empty()) std::printf("%s\n", writePicture().c_str());
    std::printf("%s\n", comparison.right() ? "all models are right" : "NOT all models are right");
    return comparison.right() ? 0 : 1;
  }

 private:
  void onTruth(const SceneTruth::ConstPtr& truth) {
    scene_ = truth->scene;
    truths_.push_back(truth);
    script_ended_ = script_ended_ || truth->last;
    double opening = 0;
    for (const JointTruth& joint : truth->joints)
      if (joint.q_max > joint.q_min) opening += std::abs(joint.q) / (joint.q_max - joint.q_min);
    openings_[truth->header.stamp] = opening;
  }

  void onModels(const ArticulationModelArray::ConstPtr& models) {
    ++model_messages_;
    models_ = *models;
  }

  void onOverlay(const sensor_msgs::Image::ConstPtr& image) {
    const auto opening = openings_.find(image->header.stamp);
    if (opening == openings_.end() || (overlay_ && opening->second < overlay_opening_)) return;
    overlay_ = image;
    overlay_opening_ = opening->second;
  }

  SceneComparison compare() const {
    TruthComparison comparison;
    for (const SceneTruth::ConstPtr& truth : truths_)
      comparison.add(inFrame(*truth, models_.models.empty() ? truth->header.frame_id : models_.header.frame_id));
    return comparison.compare(models_.models, TruthLimits());
  }

  std::string writePicture() const {
    if (!overlay_) return "no overlay came, no picture written";
    if (!cv::imwrite(picture_, cv_bridge::toCvShare(overlay_, "bgr8")->image)) return "cannot write " + picture_;
    return "picture: " + picture_;
  }

  ros::NodeHandle node_, private_;
  ros::Subscriber truth_subscriber_, models_subscriber_, overlay_subscriber_;
  double timeout_ = 0, settle_ = 0, overlay_opening_ = 0;
  std::string picture_, scene_;
  std::vector<SceneTruth::ConstPtr> truths_;
  ArticulationModelArray models_;
  std::map<ros::Time, double> openings_;
  sensor_msgs::Image::ConstPtr overlay_;
  int model_messages_ = 0;
  bool script_ended_ = false;
};

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  ros::init(argc, argv, "demo_report");
  return cabinet_articulation::DemoReport().run();
}
