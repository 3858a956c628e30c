// SPDX-License-Identifier: BSD-3-Clause
#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/planes/plane_segmenter.h"
#include "nodelets/frame_input.h"
#include "nodelets/stage_nodelet.h"
#include "ros/plane_messages.h"

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
    loadSettings(config, input, sync, transport);
    segmenter_ = std::make_unique<core::PlaneSegmenter>(config);
    offerTuning<core::PlanesConfig>(config,
                                    [this](const auto& tuned) { segmenter_ = std::make_unique<core::PlaneSegmenter>(tuned); });
    frames_ = std::make_unique<FrameInput>(getNodeHandle(), getPrivateNodeHandle(), input, sync, transport, guard());
    for (const WatchedSubscriber* topic : frames_->required()) require(topic);
    planes_ = advertise<PlaneArray>("planes");
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
      const std::vector<core::PlaneRegion> planes = segmenter_->process(views.frame);
      health().note("planes", static_cast<double>(planes.size()));
      publish(planes_, messages_.make(planes, messages.header()));
    });
  }

  std::unique_ptr<core::PlaneSegmenter> segmenter_;
  PlaneMessages messages_;
  ros::Publisher planes_;
  int left_out_ = 0;
  std::unique_ptr<FrameInput> frames_;
};

using PlanesNodelet = EndsInOrder<PlanesStage>;

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::PlanesNodelet, nodelet::Nodelet)
