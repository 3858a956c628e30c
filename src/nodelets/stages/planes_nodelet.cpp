// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include "bend/sensor_bend.h"
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "nodelets/input/frame_input.h"
#include "nodelets/stages/stage_nodelet.h"
#include "pipeline/kept_bends.h"
#include "ros/messages/plane_messages.h"

namespace cabinet_articulation {
namespace {

double validShare(const cv::Mat1f& disparity) {
  size_t valid = 0;
  for (int v = 0; v < disparity.rows; ++v) {
    const float* row = disparity[v];
    for (int u = 0; u < disparity.cols; ++u) valid += core::isValidDisparity(row[u]);
  }
  return disparity.empty() ? 0 : static_cast<double>(valid) / static_cast<double>(disparity.total());
}

}  // namespace

/// Disparity or depth -> plane regions with their masks.
class PlanesStage : public StageNodelet {
 public:
  PlanesStage() : StageNodelet("planes") {}

 private:
  void start() override {
    core::PlanesConfig config;
    FrameInputConfig input;
    SyncConfig sync;
    ImageTransportConfig transport;
    BendFileConfig file;
    loadSettings(config, file, input, sync, transport);
    const auto apply = [this](const core::PlanesConfig& tuned) {
      segmenter_ = std::make_unique<core::PlaneSegmenter>(tuned);
      unbends_ = tuned.bend;
    };
    apply(config);
    offerTuning<core::PlanesConfig>(config, apply);
    frames_ = std::make_unique<FrameInput>(getNodeHandle(), getPrivateNodeHandle(), input, sync, transport, guard());
    for (const WatchedSubscriber* topic : frames_->required()) require(topic);
    planes_ = advertise<PlaneArray>("planes");
    loadBends(file.bend_file);
  }

  /// What is no such file is left alone: nothing is loaded, and nothing saved.
  void loadBends(const std::string& file) {
    if (file.empty()) return;
    try {
      kept_.read(file);
      bend_file_ = file;
      NODELET_INFO("%s: bends of %zu cameras read from '%s'", getName().c_str(), kept_.size(), file.c_str());
    } catch (const std::exception& error) {
      const std::string text = std::string(error.what()) + "; it is left as it is, and nothing will be saved to it";
      health().setLasting("bend_file", text);
      NODELET_ERROR("%s: %s", getName().c_str(), text.c_str());
    }
  }

  void finish() override {
    try {
      const std::size_t saved = kept_.save(bend_);
      if (saved > 0) NODELET_INFO("%s: bends of %zu cameras saved to '%s'", getName().c_str(), saved, bend_file_.c_str());
    } catch (const std::exception& error) {
      NODELET_ERROR("%s: %s; the bend is not saved", getName().c_str(), error.what());
    }
  }

  void subscribe() override {
    frames_->subscribe([this](const FrameMessages& messages) { workOnNewest([this, messages] { process(messages); }); },
                       [this](const std::string& why) {
                         health().note("frames before the first CameraInfo", ++left_out_);
                         trouble("no camera", why);
                       });
  }

  void unsubscribe() override {
    if (frames_) frames_->unsubscribe();
  }

  void process(const FrameMessages& messages) {
    runStage(messages.header(), [&] {
      const FrameViews views = frames_->view(messages);
      const double valid = validShare(views.frame.disparity);
      health().note("pixels with depth [%]", 100 * valid);
      if (valid == 0)
        trouble("no depth", frames_->topic() +
                                ": no pixel has a valid depth; is the lens covered, the projector off or everything too close?");
      kept_.follow(messages.header().frame_id, &bend_);
      const bool is_bent = unbends_ && views.frame.left.empty();
      const core::DepthFrame flat = is_bent ? bend_.correct(views.frame) : views.frame;
      const std::vector<core::PlaneRegion> planes = segmenter_->process(flat, is_bent ? bend_.remaining() : core::kMostBend);
      health().note("planes", static_cast<double>(planes.size()));
      const PlaneArrayPtr message = messages_.make(planes, messages.header());
      if (is_bent) message->bend = toMessage(bend_.bend());
      publish(planes_, message);
      if (is_bent) learnBend(views.frame, planes);
    });
  }

  void learnBend(const core::DepthFrame& frame, const std::vector<core::PlaneRegion>& planes) {
    const bool was_known = bend_.isKnown();
    bend_.learn(frame, planes);
    if (bend_.views() == 0) return;
    health().note("largest correction of a bent depth [px]", bend_.largest());
    health().note("what may be left of the bend [px]", bend_.remaining());
    health().note("views of large surfaces that it is known from", static_cast<double>(bend_.views()));
    if (bend_.isKnown() != was_known) NODELET_INFO("%s: %s", getName().c_str(), bend_.inWords().c_str());
  }

  std::unique_ptr<core::PlaneSegmenter> segmenter_;
  bool unbends_ = true;
  core::SensorBend bend_;
  core::KeptBends kept_;
  std::string bend_file_;  ///< empty: none, or no such file
  PlaneMessages messages_;
  ros::Publisher planes_;
  int left_out_ = 0;
  std::unique_ptr<FrameInput> frames_;
};

using PlanesNodelet = EndsInOrder<PlanesStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::PlanesNodelet, nodelet::Nodelet)
