// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/structure/structure_finder.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace cabinet_articulation::core {
namespace {

SimulationConfig configOf(const std::string& scene, int seed) {
  SimulationConfig config;
  config.scene = scene;
  config.scene_seed = seed;
  return config;
}

/// The truth of a scene in the world, as a detector would see it. Ids count from 1 in the order of the scene's joints.
class Detections {
 public:
  Detections(const std::string& scene, int seed) : camera_(configOf(scene, seed)), random_(static_cast<unsigned>(seed)) {
    for (const FrontTruth& front : camera_.truth(0).joints) {
      Track track;
      track.id = static_cast<std::uint32_t>(tracks_.size() + 1);
      track.width = front.rectangle.width;
      track.height = front.rectangle.height;
      tracks_.push_back(track);
    }
  }

  int frameCount() const { return camera_.frameCount(); }

  const std::vector<Track>& see(int frame) {
    const GroundTruth truth = camera_.truth(frame);
    for (std::size_t i = 0; i < tracks_.size(); ++i) {
      if (std::uniform_real_distribution<double>()(random_) < 0.1) continue;  // not detected
      TrackedObservation observation;
      observation.stamp = 100 + truth.time;
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
    }
    return tracks_;
  }

 private:
  static constexpr double kPosition = 0.002, kOrientation = 0.006;  ///< [m], [rad]

  Eigen::Vector3d noise() { return {normal_(random_), normal_(random_), normal_(random_)}; }

  SimulatedStereoCamera camera_;
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  std::vector<Track> tracks_;
};

struct Learned {
  std::vector<LearnedModel> models;
  std::vector<CoupledFronts> coupled;
  double longest = 0;  ///< [s] that one update of the structure took
};

Learned learn(const std::string& scene, int seed, StructureFinder* finder) {
  Detections detections(scene, seed);
  ArticulationLearner learner{ArticulationConfig()};
  Learned learned;
  for (int frame = 0; frame < detections.frameCount(); ++frame) {
    const std::vector<Track>& tracks = detections.see(frame);
    learned.models = learner.process(tracks);
    const auto start = std::chrono::steady_clock::now();
    finder->complete(tracks, &learned.models);
    learned.longest = std::max(learned.longest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  learned.coupled = finder->coupled();
  return learned;
}

Learned learn(const std::string& scene, int seed = 1) {
  StructureFinder finder{ArticulationConfig()};
  return learn(scene, seed, &finder);
}

std::vector<std::uint32_t> parents(const std::vector<LearnedModel>& models) {
  std::vector<std::uint32_t> parents;
  for (const LearnedModel& model : models) parents.push_back(model.parent);
  return parents;
}

/// [m] The mean error of the front's centre over the whole range, with the parent wherever it is.
double predictionError(const std::string& scene, int seed, const std::vector<LearnedModel>& models, std::size_t front) {
  const SimulatedStereoCamera camera(configOf(scene, seed));
  double sum = 0;
  for (int frame = 0; frame < camera.frameCount(); ++frame) {
    const GroundTruth truth = camera.truth(frame);
    std::vector<LearnedModel> now = models;
    const Eigen::Isometry3d pose = truth.T_world_camera * truth.joints[front].rectangle.pose;
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now[i].parent == 0) now[i].q = now[i].configuration(truth.T_world_camera * truth.joints[i].rectangle.pose);
    const LearnedModel model = placed(now[front], now);
    sum += (model.predict(model.configuration(pose)).translation() - pose.translation()).norm();
  }
  return sum / camera.frameCount();
}

using Parents = std::vector<std::uint32_t>;

constexpr double kLongestUpdate = 0.5;  ///< [s] measured: 0.04; a machine may be busy

TEST(StructureFinder, SecondLeafOfAFoldingDoorHangsOnTheFirst) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Learned learned = learn("bifold", seed);
    ASSERT_EQ(parents(learned.models), Parents({0, 1})) << seed;
    EXPECT_GT(learned.models[1].parent_probability, 0.9);
    EXPECT_EQ(learned.models[1].type, JointType::kRotational);
    EXPECT_LT(predictionError("bifold", seed, learned.models, 1), 0.004) << seed;
    ASSERT_EQ(learned.coupled.size(), 1U) << seed;
    EXPECT_NEAR(std::abs(learned.coupled[0].ratio), 2, 0.1);
    EXPECT_LT(learned.longest, kLongestUpdate);
  }
}

TEST(StructureFinder, DrawersOfATrolleyHangOnItsFace) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Learned learned = learn("trolley", seed);
    ASSERT_EQ(parents(learned.models), Parents({0, 1, 1})) << seed;
    for (const std::size_t drawer : {1U, 2U}) {
      EXPECT_EQ(learned.models[drawer].type, JointType::kPrismatic);
      EXPECT_LT(predictionError("trolley", seed, learned.models, drawer), 0.004) << seed;
    }
  }
}

TEST(StructureFinder, FrontsOfOneCabinetHangOnTheWorld) {
  for (const char* scene : {"cupboard", "kitchen", "pedestal", "door"})
    for (int seed = 1; seed <= 5; ++seed) {
      const Learned learned = learn(scene, seed);
      EXPECT_EQ(parents(learned.models), Parents(learned.models.size(), 0)) << scene << ' ' << seed;
      EXPECT_TRUE(learned.coupled.empty()) << scene << ' ' << seed;
    }
}

/// The first frames of the folding door, at rest, seen by a finder that may know something.
std::vector<LearnedModel> seeAtRest(StructureFinder* finder, ArticulationLearner* learner) {
  Detections detections("bifold", 7);
  std::vector<LearnedModel> models;
  for (int frame = 0; frame < 5; ++frame) {
    const std::vector<Track>& tracks = detections.see(frame);
    models = learner->process(tracks);
    finder->complete(tracks, &models);
  }
  return models;
}

TEST(StructureFinder, RemembersAParentUntilItIsForgotten) {
  const std::vector<LearnedModel> known = learn("bifold", 7).models;
  ASSERT_EQ(parents(known), Parents({0, 1}));
  StructureFinder finder{ArticulationConfig()};
  ArticulationLearner learner{ArticulationConfig()};
  learner.remember(thoseOfTheWorld(known));
  finder.remember(known);
  const std::vector<LearnedModel> models = seeAtRest(&finder, &learner);
  ASSERT_EQ(parents(models), Parents({0, 1}));
  EXPECT_EQ(models[1].type, JointType::kRotational);
  EXPECT_EQ(models[1].parent_probability, known[1].parent_probability);
  finder.forget(1);
  EXPECT_EQ(parents(seeAtRest(&finder, &learner)), Parents({0, 0}));
}

TEST(StructureFinder, DoesWithTracksThatSayNothing) {
  StructureFinder finder{ArticulationConfig()};
  std::vector<LearnedModel> none;
  finder.complete({}, &none);
  Detections detections("bifold", 1);
  std::vector<Track> tracks = detections.see(0);
  LearnedModel model;
  model.type = JointType::kPrismatic;
  model.moved = true;
  model.q_max = 0.3;
  std::vector<LearnedModel> models(2, model);
  models[0].id = 1;
  models[1].id = 2;
  tracks[1].observations.assign(3, tracks[0].observations.empty() ? TrackedObservation() : tracks[0].observations[0]);
  tracks[1].observations[1].rectangle.pose.translation().setConstant(std::nan(""));
  tracks[1].observations[2].stamp = std::nan("");
  finder.complete(tracks, &models);
  EXPECT_EQ(parents(models), Parents({0, 0}));
}

}  // namespace
}  // namespace cabinet_articulation::core
