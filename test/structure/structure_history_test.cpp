// SPDX-License-Identifier: BSD-3-Clause
// What hangs on what, after long watches, lost parents and earlier runs.
#include <gtest/gtest.h>

#include <string>

#include "cabinet_articulation/joints/hanging.h"
#include "structure/detections.h"

namespace cabinet_articulation::core {
namespace {

using test::Detections;
using test::learn;
using test::parents;
using test::Parents;

/// Of a learner and a finder that see one scene for long.
struct Watch {
  explicit Watch(const std::string& scene, int seed = 1) : detections(scene, seed) {}

  void see(int frame) {
    const std::vector<Track>& tracks = detections.see(frame, stamp += kPeriod);
    models = learner.process(tracks);
    finder.complete(tracks, &models);
  }

  static constexpr double kPeriod = 0.1;  // [s]
  Detections detections;
  ArticulationLearner learner{ArticulationConfig()};
  StructureFinder finder{ArticulationConfig()};
  std::vector<LearnedModel> models;
  double stamp = 100;
};

TEST(StructureHistory, FindsAParentThatMovesOnlyAfterALongWatch) {
  Watch watch("trolley");
  const int frames = watch.detections.frameCount();
  for (int frame = 0; frame < frames / 4; ++frame) watch.see(frame);
  const int rests = frames / 4;
  for (int i = 0; i < 1800; ++i) watch.see(rests);
  EXPECT_LE(watch.detections.see(rests, watch.stamp += 0.1)[0].observations.size(), 1000U);
  for (int frame = rests; frame < frames; ++frame) watch.see(frame);
  EXPECT_EQ(parents(watch.models), Parents({0, 1, 1}));
}

TEST(StructureHistory, AChildIsDescribedInTheWorldWhileItsParentIsNoJoint) {
  Detections detections("bifold", 7);
  ArticulationLearner learner{ArticulationConfig()};
  StructureFinder finder{ArticulationConfig()};
  std::vector<LearnedModel> models;
  for (int frame = 0; frame < detections.frameCount(); ++frame) {
    const std::vector<Track>& tracks = detections.see(frame);
    models = learner.process(tracks);
    finder.complete(tracks, &models);
  }
  ASSERT_EQ(parents(models), Parents({0, 1}));
  const std::vector<Track> tracks = detections.see(detections.frameCount() - 1);
  std::vector<LearnedModel> doubted = learner.process(tracks);
  const std::vector<LearnedModel> in_world = doubted;
  doubted[0].doubt = 1;
  finder.complete(tracks, &doubted);
  EXPECT_EQ(parents(doubted), Parents({0, 0}));
  EXPECT_TRUE(hangsOnKnown(doubted[1], doubted));
  EXPECT_TRUE(doubted[1].origin.isApprox(in_world[1].origin)) << "as it was learned in the world";
  std::vector<LearnedModel> alone{doubted[1]};
  finder.complete({tracks[1]}, &alone);
  EXPECT_EQ(alone[0].parent, 0U) << "nor while that is out of view since";
  std::vector<LearnedModel> again = learner.process(tracks);
  finder.complete(tracks, &again);
  EXPECT_EQ(parents(again), Parents({0, 1}));
}

TEST(StructureHistory, AnEdgeOfAnEarlierRunIsRefutedByTheChildThatRests) {
  // What the file says of a cupboard is wrong: its first door does not carry the second.
  const std::vector<LearnedModel> learned = learn("cupboard").models;
  std::vector<LearnedModel> known = learned;
  ASSERT_TRUE(isJoint(known[0]) && isJoint(known[1]));
  known[1] = transformed(known[1], known[0].predict(known[0].q).inverse());
  known[1].parent = known[0].id;
  known[1].parent_probability = 0.999;
  StructureFinder finder{ArticulationConfig()};
  finder.remember(known);
  EXPECT_EQ(parents(learn("cupboard", 2, &finder).models), Parents(learned.size(), 0));
}

TEST(StructureHistory, SwitchedOffOnlyAnEarlierRunTellsOfParents) {
  StructureConfig off;
  off.hanging = false;
  StructureFinder finder{ArticulationConfig(), off};
  EXPECT_EQ(parents(learn("bifold", 1, &finder).models), Parents({0, 0}));
  finder.remember(learn("bifold", 1).models);
  EXPECT_EQ(parents(learn("bifold", 1, &finder).models), Parents({0, 1}));
}

TEST(StructureHistory, CoupledFrontsAreForgottenWithEitherOfThem) {
  StructureFinder finder{ArticulationConfig()};
  ASSERT_EQ(learn("bifold", 1, &finder).coupled.size(), 1U);
  finder.forget(2);
  EXPECT_TRUE(finder.coupled().empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
