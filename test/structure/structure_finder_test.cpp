// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/structure/structure_finder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cabinet_articulation/joints/hanging.h"
#include "structure/detections.h"

namespace cabinet_articulation::core {
namespace {

using test::configOf;
using test::Detections;
using test::learn;
using test::Learned;
using test::parents;
using test::Parents;

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
