// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "tools/report/chart.h"
#include "tools/report/thinned.h"

namespace cabinet_articulation {

/// So many samples of a front are enough for a chart (ours).
constexpr std::size_t kMostSamples = 600;

/// One observation of a front, in the frame that its model is described in. Times are seconds since the run's first frame.
struct FrontSample {
  double time = 0;
  core::Rectangle rectangle;
  std::array<float, 4> edge_support{};
};

/// What the learner thought of a front after one frame.
struct Opinion {
  double time = 0;
  std::vector<double> probabilities;  ///< index = JointType
};

/// The history of one front, in bounded memory.
struct FrontRecord {
  core::LearnedModel model;  ///< as it was known last
  /// Where the frame was in which the model is described: that of the front it hangs on, or the world itself. Nothing if nobody
  /// knows.
  std::optional<Eigen::Isometry3d> frame = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< of that frame when it was known last
  std::optional<double> hangs_since;                   ///< samples are those since then
  bool was_seen = false;
  Thinned<FrontSample> observations{kMostSamples};
  Thinned<Opinion> opinions{kMostSamples};
  std::vector<Range> unseen;          ///< times without observations, the longest ones, in order
  std::optional<double> first_joint;  ///< time when it was told to be a joint
  double first_seen = 0, last_seen = 0;
};

/// Milliseconds of one frame.
struct FrameTimes {
  double time = 0;
  core::StageTimes milliseconds;
};

/// Collects what a report shows of a run. Only fronts that moved stay when they are out of view. Memory is bounded.
class RunRecord {
 public:
  /// To be called for each frame. A stamp that is not newer than the one before (a bag in a loop) continues the time. Returns
  /// the ids of fronts that were told to be joints for the first time.
  std::vector<std::uint32_t> add(double stamp, const core::PipelineResult& result);

  /// Once, at the end: before it was found and after its last observation, a front was not seen.
  void close();

  /// Those that moved, by id.
  std::vector<const FrontRecord*> moved() const;

  double end() const { return time_; }  ///< time of the last frame
  double period() const { return frames_ > 1 ? time_ / (frames_ - 1) : 0; }
  int frames() const { return frames_; }
  int leftOut() const { return left_out_; }  ///< fronts that moved, beyond those that there was room for
  std::vector<FrameTimes> times() const { return times_.values(); }

 private:
  void advance(double stamp);
  void describe(const core::LearnedModel& model, const std::vector<core::LearnedModel>& all, FrontRecord* front) const;
  void observe(const core::TrackedObservation& observation, FrontRecord* front) const;
  void forgetOthers(const std::vector<core::LearnedModel>& models);

  std::map<std::uint32_t, FrontRecord> fronts_;
  Thinned<FrameTimes> times_{kMostSamples};
  int frames_ = 0, left_out_ = 0;
  double stamp_ = 0, time_ = 0, time_before_ = 0;
};

}  // namespace cabinet_articulation
