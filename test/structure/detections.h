// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "cabinet_articulation/structure/structure_finder.h"
#include "tracking/motion/history.h"

namespace cabinet_articulation {
namespace test {

using Parents = std::vector<std::uint32_t>;

inline core::SimulationConfig configOf(const std::string& scene, int seed) {
  core::SimulationConfig config;
  config.scene = scene;
  config.scene_seed = seed;
  return config;
}

/// The truth of a scene in the world, as a detector would see it. Ids count from 1 in the order of the scene's joints.
class Detections {
 public:
  Detections(const std::string& scene, int seed) : camera_(configOf(scene, seed)), random_(static_cast<unsigned>(seed)) {
    for (const core::FrontTruth& front : camera_.truth(0).joints) {
      core::Track track;
      track.id = static_cast<std::uint32_t>(tracks_.size() + 1);
      track.width = front.rectangle.width;
      track.height = front.rectangle.height;
      tracks_.push_back(track);
    }
  }

  int frameCount() const { return camera_.frameCount(); }

  const std::vector<core::Track>& see(int frame) { return see(frame, 100 + camera_.truth(frame).time); }

  const std::vector<core::Track>& see(int frame, double stamp) {
    const core::GroundTruth truth = camera_.truth(frame);
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (std::uniform_real_distribution<double>()(random_) < 0.1) continue;  // not detected
      core::TrackedObservation observation;
      observation.stamp = stamp;
      observation.rectangle = truth.joints[i].rectangle;
      observation.rectangle.pose = truth.T_world_camera * observation.rectangle.pose;
      observation.rectangle.pose.pretranslate(kPosition * noise());
      const Eigen::Vector3d turn = kOrientation * noise();
      observation.rectangle.pose.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      observation.covariance.diagonal() << Eigen::Vector3d::Constant(kPosition * kPosition),
          Eigen::Vector3d::Constant(kOrientation * kOrientation);
      observation.measured = observation.rectangle;
      observation.measured_covariance = observation.covariance;
      tracks_[i].observations.push_back(observation);
      core::thinOut(tracks_[i].observations, kMostObservations);
    }
    return tracks_;
  }

 private:
  static constexpr int kMostObservations = 1000;                    ///< as the tracker keeps
  static constexpr double kPosition = 0.002, kOrientation = 0.006;  ///< [m], [rad]

  Eigen::Vector3d noise() { return {normal_(random_), normal_(random_), normal_(random_)}; }

  core::SimulatedStereoCamera camera_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::vector<core::Track> tracks_;
};

struct Learned {
  std::vector<core::LearnedModel> models;
  std::vector<core::CoupledFronts> coupled;
  double longest = 0;  ///< [s] that one update of the structure took
};

inline Learned learn(const std::string& scene, int seed, core::StructureFinder* finder) {
  Detections detections(scene, seed);
  core::ArticulationLearner learner{core::ArticulationConfig()};
  Learned learned;
  for (int frame = 0; frame < detections.frameCount(); ++frame) {
    const std::vector<core::Track>& tracks = detections.see(frame);
    learned.models = learner.process(tracks);
    const auto start = std::chrono::steady_clock::now();
    finder->complete(tracks, &learned.models);
    learned.longest = std::max(learned.longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  learned.coupled = finder->coupled();
  return learned;
}

inline Learned learn(const std::string& scene, int seed = 1) {
  core::StructureFinder finder{core::ArticulationConfig()};
  return learn(scene, seed, &finder);
}

inline std::vector<std::uint32_t> parents(const std::vector<core::LearnedModel>& models) {
  std::vector<std::uint32_t> parents;
  for (const core::LearnedModel& model : models) parents.push_back(model.parent);
  return parents;
}

}  // namespace test
}  // namespace cabinet_articulation
