// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <stdexcept>

#include "sources/track_source.h"
#include "sources/variants.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kSameFront = 0.5;   ///< IoU with the truth from which a track is taken to be the front's
constexpr double kSamePlace = 0.05;  ///< [m] distance of the centres along the normal

/// Index of the front that opens farthest.
std::size_t movingFront(const std::vector<Frame>& frames) {
  std::size_t best = 0;
  double farthest = 0;
  for (const Frame& frame : frames)
    for (std::size_t i = 0; i < frame.fronts.size(); ++i) {
      if (frame.fronts[i].opened <= farthest) continue;
      farthest = frame.fronts[i].opened;
      best = i;
    }
  if (farthest == 0) throw std::runtime_error("nothing moves");
  return best;
}

class TrackedFrames : public TrackSource {
 public:
  explicit TrackedFrames(FrameSource& source) {
    BlockMatcher matcher(ourVariant().config.stereo);
    for (int i = 0; i < source.size(); ++i) {
      frames_.push_back(source.frame(i));
      depth_.push_back(depthFrame(frames_.back(), source.camera(), &matcher));
      frames_.back().releaseImages();
    }
    const std::size_t front = movingFront(frames_);
    facts_ = {source.name(), frames_[0].fronts[front].type, true, true};
    for (const Frame& frame : frames_) {
      ReferencePose pose{frame.fronts[front].rectangle, frame.fronts[front].opened};
      pose.rectangle.pose = frame.T_world_camera * pose.rectangle.pose;
      reference_.push_back(pose);
    }
  }

  const SourceFacts& facts() const override { return facts_; }
  const std::vector<ReferencePose>& reference() const override { return reference_; }

  void observe(const std::vector<int>& picked, const std::function<void(const SeenFront&)>& visit) const override {
    Pipeline pipeline(ourVariant().config);
    for (const int i : picked) {
      const PipelineResult seen = pipeline.process(frames_[i].stamp, depth_[i], frames_[i].T_world_camera);
      const Track* track = frontTrack(*seen.tracks, i);
      if (!track) continue;
      const auto own = [&](const LearnedModel& model) { return model.id == track->id; };
      const auto model = std::find_if(seen.models.begin(), seen.models.end(), own);
      visit({*track, model == seen.models.end() ? nullptr : &*model});
    }
  }

 private:
  /// The track that was continued in frame `index` by what lies over the true front best.
  const Track* frontTrack(const std::vector<Track>& tracks, int index) const {
    const Rectangle& truth = reference_[index].rectangle;
    const Track* best = nullptr;
    double best_iou = kSameFront;
    for (const Track& track : tracks) {
      const TrackedObservation& last = track.observations.back();
      if (last.stamp != frames_[index].stamp || std::abs(truth.plane().distance(last.rectangle.center())) > kSamePlace) continue;
      const double iou = intersectionOverUnion(truth, last.rectangle);
      if (iou <= best_iou) continue;
      best = &track;
      best_iou = iou;
    }
    return best;
  }

  std::vector<Frame> frames_;  ///< without images
  std::vector<DepthFrame> depth_;
  SourceFacts facts_;
  std::vector<ReferencePose> reference_;
};

}  // namespace

std::unique_ptr<TrackSource> trackFrames(FrameSource& frames) { return std::make_unique<TrackedFrames>(frames); }

}  // namespace cabinet_articulation::core::evaluation
