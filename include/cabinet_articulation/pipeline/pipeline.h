// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/known_fronts.h"
#include "cabinet_articulation/kinds/kinds_config.h"
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "cabinet_articulation/rectangles/rectangle_detector.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "cabinet_articulation/stereo/depth_view.h"
#include "cabinet_articulation/tracking/rectangle_tracker.h"
#include "cabinet_articulation/tracking/track_updates.h"

namespace cabinet_articulation::core {

class ClosedFinder;
class KindMemory;
class SensorBend;
class StructureFinder;

/// The settings of all five stages.
struct PipelineConfig {
  StereoConfig stereo;
  PlanesConfig planes;
  RectanglesConfig rectangles;
  TrackingConfig tracking;
  ArticulationConfig articulation;
  KindsConfig kinds;          ///< in articulation.yaml too
  StructureConfig structure;  ///< in articulation.yaml too

  /// Reads <directory>/{stereo,planes,rectangles,tracking,articulation}.yaml; a missing file keeps that stage's defaults.
  /// Throws ConfigError, also when there is no such directory; warnings about unknown keys are appended.
  static PipelineConfig load(const std::string& directory, std::vector<std::string>* warnings);

  /// The recipe of the paper, as far as our settings can express it: the baseline of comparisons, also in config/paper.
  static PipelineConfig paper();
};

/// Milliseconds of wall time each stage took for one frame.
struct StageTimes {
  double stereo = 0, planes = 0, rectangles = 0, tracking = 0, articulation = 0;
};

/// What one frame gave. Rectangles in the left optical frame, tracks and models in the fixed frame. Histories are long: the
/// pointer is valid until the next call.
struct PipelineResult {
  DepthFrame frame;  ///< as it was measured
  std::vector<PlaneRegion> planes;
  std::vector<DetectedRectangle> rectangles;
  DepthView view;  ///< in the fixed frame, as the learner saw it
  const std::vector<Track>* tracks = nullptr;
  std::vector<TrackUpdate> track_updates;  ///< what is new of them
  std::vector<LearnedModel> models;
  StageTimes milliseconds;
};

/// The five stages in one object: two camera images in, models out. The nodelets do the same with the same data, to the bit. What
/// goes from stage to stage here has been through what messages do to it.
class Pipeline {
 public:
  explicit Pipeline(const PipelineConfig& config);
  ~Pipeline();

  /// A rectified stereo pair, seen at `stamp` [s]. `T_fixed_camera` places the left optical frame in the frame the models
  /// live in. Throws as BlockMatcher::process. A stamp that is not newer than the last one teaches nothing: tracks and
  /// models stay as they are.
  PipelineResult process(double stamp, const cv::Mat& left, const cv::Mat& right, const StereoCamera& camera,
                         const Eigen::Isometry3d& T_fixed_camera = Eigen::Isometry3d::Identity());

  /// The same from a ready depth frame (a depth camera or another matcher).
  PipelineResult process(double stamp, const DepthFrame& frame,
                         const Eigen::Isometry3d& T_fixed_camera = Eigen::Isometry3d::Identity());

  const std::vector<Track>& tracks() const { return known_.tracks(); }

  /// What is known of the bend of a depth camera, in words; empty for a pair, or without the setting `bend`.
  std::string bend() const;

  /// The same, for who keeps it from run to run; null without the setting `bend`.
  SensorBend* sensorBend();

  /// Forgets all tracks and models; the bend of the camera stays.
  void reset();

  /// Time was set back: joints stay known, and get their ids and histories back when they are seen again; all else is
  /// forgotten. As in the nodelets, the tracker hears which fronts are joints after the next frame.
  void startAfresh();

 private:
  void tellTrackerOfJoints();

  BlockMatcher stereo_;
  std::unique_ptr<SensorBend> bend_;  ///< none without the setting `bend`
  PlaneSegmenter planes_;
  RectangleDetector rectangles_;
  RectangleTracker tracking_;
  TrackUpdates updates_;
  KnownFronts known_;
  std::vector<Track> joints_;    ///< that the tracker was told of, or will be
  bool joints_are_new_ = false;  ///< to be told after the next frame
  bool joints_are_due_ = false;  ///< to be told now
  ArticulationLearner articulation_;
  std::unique_ptr<KindMemory> kinds_;
  std::unique_ptr<ClosedFinder> closed_;
  std::unique_ptr<StructureFinder> structure_;
};

/// Where fronts are expected at `stamp` [s], in the camera's frame, for the detector.
std::vector<Rectangle> expectedInCamera(const ExpectedFronts& fronts, double stamp, const Eigen::Isometry3d& T_fixed_camera);

/// Rectangles given in the camera's frame, seen from the fixed frame (poses and covariances).
std::vector<DetectedRectangle> transformed(const std::vector<DetectedRectangle>& rectangles,
                                           const Eigen::Isometry3d& T_fixed_camera);

}  // namespace cabinet_articulation::core
