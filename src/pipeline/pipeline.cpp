// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/pipeline/pipeline.h"

#include <chrono>
#include <filesystem>
#include <utility>

#include "bend/sensor_bend.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/structure/structure_finder.h"
#include "closing/closed_finder.h"
#include "geometry/message_precision.h"
#include "geometry/turned_covariance.h"
#include "kinds/kind_memory.h"
#include "pipeline/as_sent.h"

namespace cabinet_articulation::core {
namespace {

/// Runs one stage and writes down how long it took.
template <class Stage>
auto timed(double& milliseconds, Stage&& stage) {
  const auto start = std::chrono::steady_clock::now();
  auto result = stage();
  milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return result;
}

template <class Config>
Config loadOrDefault(const std::string& path, std::vector<std::string>* warnings) {
  return std::filesystem::exists(path) ? loadConfig<Config>(path, warnings) : Config();
}

}  // namespace

PipelineConfig PipelineConfig::load(const std::string& directory, std::vector<std::string>* warnings) {
  if (!std::filesystem::is_directory(directory)) throw ConfigError("configuration directory '" + directory + "' does not exist");
  PipelineConfig config;
  config.stereo = loadOrDefault<StereoConfig>(directory + "/stereo.yaml", warnings);
  config.planes = loadOrDefault<PlanesConfig>(directory + "/planes.yaml", warnings);
  config.rectangles = loadOrDefault<RectanglesConfig>(directory + "/rectangles.yaml", warnings);
  config.tracking = loadOrDefault<TrackingConfig>(directory + "/tracking.yaml", warnings);
  const auto learning = loadOrDefault<LearningConfig>(directory + "/articulation.yaml", warnings);
  config.articulation = learning.articulation;
  config.kinds = learning.kinds;
  config.structure = learning.structure;
  return config;
}

Pipeline::Pipeline(const PipelineConfig& config)
    : stereo_(config.stereo),
      bend_(config.planes.bend ? std::make_unique<SensorBend>() : nullptr),
      planes_(config.planes),
      rectangles_(config.rectangles, config.planes),
      tracking_(config.tracking),
      articulation_(config.articulation),
      kinds_(std::make_unique<KindMemory>(LearningConfig{config.articulation, config.kinds, config.structure})),
      closed_(std::make_unique<ClosedFinder>()),
      structure_(std::make_unique<StructureFinder>(config.articulation, config.structure)) {}

Pipeline::~Pipeline() = default;

PipelineResult Pipeline::process(double stamp, const cv::Mat& left, const cv::Mat& right, const StereoCamera& camera,
                                 const Eigen::Isometry3d& T_fixed_camera) {
  double stereo_milliseconds = 0;
  const DepthFrame frame = timed(stereo_milliseconds, [&] { return stereo_.process(left, right, camera); });
  PipelineResult result = process(stamp, frame, T_fixed_camera);
  result.milliseconds.stereo = stereo_milliseconds;
  return result;
}

PipelineResult Pipeline::process(double stamp, const DepthFrame& frame, const Eigen::Isometry3d& T_fixed_camera) {
  PipelineResult result;
  StageTimes& times = result.milliseconds;
  result.frame = frame;
  DepthFrame flat = frame;
  result.planes = timed(times.planes, [&] {
    if (bend_) flat = bend_->correct(frame);
    std::vector<PlaneRegion> planes = planes_.process(flat, bend_ ? bend_->remaining() : kMostBend);
    if (bend_) bend_->learn(frame, planes);
    return planes;
  });
  result.rectangles = timed(times.rectangles, [&] {
    return rectangles_.process(flat, result.planes, expectedInCamera(asSent(tracking_.expected()), stamp, T_fixed_camera));
  });
  result.view = thinnedOut(flat);
  result.view.stamp = stamp;
  result.view.T_fixed_camera = asSent(T_fixed_camera);
  result.track_updates = timed(times.tracking, [&] {
    if (std::exchange(joints_are_due_, false)) tellTrackerOfJoints();
    return updates_.of(tracking_.process(stamp, transformed(asSent(result.rectangles), T_fixed_camera)), stamp);
  });
  result.models = timed(times.articulation, [&] {
    known_.follow(asSent(result.track_updates));
    std::vector<LearnedModel> models = articulation_.process(known_.tracks());
    closed_->see(result.view);
    closed_->complete(&models);
    structure_->complete(known_.tracks(), &models);
    known_.update(models);
    kinds_->complete(known_.tracks(), &models);
    return models;
  });
  joints_are_due_ = std::exchange(joints_are_new_, false);
  result.tracks = &known_.tracks();
  return result;
}

SensorBend* Pipeline::sensorBend() { return bend_.get(); }

std::string Pipeline::bend() const { return bend_ ? bend_->inWords() : ""; }

void Pipeline::reset() {
  tracking_.reset();
  updates_.startAnew();
  known_.replace({});
  joints_.clear();
  joints_are_new_ = joints_are_due_ = false;
  articulation_.reset();
  kinds_->reset();
  closed_->reset();
  structure_->reset();
}

void Pipeline::startAfresh() {
  tellTrackerOfJoints();
  const std::vector<KnownFront> joints = known_.joints();
  std::vector<LearnedModel> models;
  joints_.clear();
  for (const KnownFront& joint : joints) {
    joints_.push_back(asSent(joint.track));
    models.push_back(joint.model);
  }
  joints_are_new_ = true;
  known_.replace(joints);
  articulation_.reset();
  articulation_.remember(thoseOfTheWorld(models));
  kinds_->keepFronts(models);
  closed_->reset();
  closed_->remember(thoseOfTheWorld(models));
  structure_->reset();
  structure_->remember(models);
}

/// It knows nothing else then.
void Pipeline::tellTrackerOfJoints() {
  tracking_.reset();
  tracking_.remember(joints_);
  updates_.startAnew();
}

std::vector<Rectangle> expectedInCamera(const ExpectedFronts& fronts, double stamp, const Eigen::Isometry3d& T_fixed_camera) {
  const Eigen::Isometry3d T_camera_fixed = T_fixed_camera.inverse();
  std::vector<Rectangle> rectangles = fronts.at(stamp);
  for (Rectangle& rectangle : rectangles) rectangle.pose = T_camera_fixed * rectangle.pose;
  return rectangles;
}

std::vector<DetectedRectangle> transformed(const std::vector<DetectedRectangle>& rectangles,
                                           const Eigen::Isometry3d& T_fixed_camera) {
  std::vector<DetectedRectangle> result = rectangles;
  for (DetectedRectangle& detection : result) {
    detection.rectangle.pose = T_fixed_camera * detection.rectangle.pose;
    detection.covariance = turned(detection.covariance, T_fixed_camera.linear());
  }
  return result;
}

}  // namespace cabinet_articulation::core
