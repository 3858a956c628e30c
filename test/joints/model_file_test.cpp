// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/model_file.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <vector>

#include "cabinet_articulation/joints/prediction.h"
#include "joints/learned_fronts.h"
#include "joints/model_folder.h"

namespace cabinet_articulation::core {
namespace {

namespace fs = std::filesystem;
using test::learned;

class ModelFiles : public test::ModelFolder {};

TEST_F(ModelFiles, BringBackWhatWasKnown) {
  ModelFile saved{"odom", {learned(test::doorModel()), learned(test::drawerModel()), learned(test::garageModel())}};
  saved.fronts[1].model.doubt = 0.25;
  saved.fronts[0].model.hollow = true;
  saveModelFile(path_, saved);
  const ModelFile loaded = readModelFile(path_);
  EXPECT_EQ(loaded.frame, "odom");
  ASSERT_EQ(loaded.fronts.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const LearnedModel& before = saved.fronts[i].model;
    const LearnedModel& after = loaded.fronts[i].model;
    EXPECT_EQ(after.id, before.id);
    EXPECT_EQ(after.type, before.type);
    EXPECT_TRUE(isJoint(after));
    EXPECT_EQ(after.doubt, before.doubt);
    EXPECT_NEAR(after.stamp, before.stamp, 1e-5);
    EXPECT_EQ(after.observations, 20);
    EXPECT_TRUE(after.q_min_is_end);
    EXPECT_FALSE(after.q_max_is_end);
    EXPECT_EQ(after.probabilities, before.probabilities);
    EXPECT_TRUE(after.origin.isApprox(before.origin, 1e-10));
    EXPECT_TRUE(after.axis.isApprox(before.axis, 1e-10));
    EXPECT_TRUE(after.axis_point.isApprox(before.axis_point, 1e-10));
    EXPECT_TRUE(after.covariance.isApprox(before.covariance, 1e-9));
    EXPECT_EQ(after.curve.size(), before.curve.size());
    EXPECT_EQ(after.hollow, before.hollow);
    EXPECT_EQ(loaded.fronts[i].track.hollow, before.hollow);
    for (const auto& field :
         {&LearnedModel::radius, &LearnedModel::pitch, &LearnedModel::q, &LearnedModel::q_min, &LearnedModel::q_max,
          &LearnedModel::width, &LearnedModel::height, &LearnedModel::position_error, &LearnedModel::orientation_error})
      EXPECT_NEAR(after.*field, before.*field, 1e-10);
    EXPECT_EQ(after.params.size(), 2u);
    EXPECT_EQ(after.params[1].name, "q_min[0]");
    EXPECT_EQ(after.params[1].kind, ModelParam::kEval);
    for (const double q : {-0.1, 0.0, 0.2, 0.9}) {
      const UncertainPose a = predictWithCovariance(before, q), b = predictWithCovariance(after, q);
      EXPECT_TRUE(a.pose.isApprox(b.pose, 1e-10)) << i << " at " << q;
      EXPECT_TRUE(a.covariance.isApprox(b.covariance, 1e-9)) << i << " at " << q;
    }
    const Track& track = loaded.fronts[i].track;
    ASSERT_EQ(track.observations.size(), 20u);
    const TrackedObservation &first = saved.fronts[i].track.observations[3], &again = track.observations[3];
    EXPECT_NEAR(again.stamp, first.stamp, 1e-5);
    EXPECT_TRUE(again.rectangle.pose.isApprox(first.rectangle.pose, 1e-10));
    EXPECT_NEAR(again.rectangle.height, first.rectangle.height, 1e-10);
    EXPECT_EQ(again.edge_support, first.edge_support);
    EXPECT_TRUE(again.covariance.isApprox(first.covariance, 1e-9));
    EXPECT_TRUE(again.measured.pose.isApprox(again.rectangle.pose));
  }
}

TEST_F(ModelFiles, OlderThanTheEndsOfARangeKnowOfNone) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  damage("    q_min_is_end: true\n", "");
  EXPECT_FALSE(readModelFile(path_).fronts.at(0).model.q_min_is_end);
}

TEST_F(ModelFiles, KeepWhereAFrontIsClosed) {
  KnownFront door = learned(test::doorModel());
  door.model.closed_known = true;
  door.model.q_closed = -0.3;
  saveModelFile(path_, {"map", {door, learned(test::drawerModel())}});
  const ModelFile loaded = readModelFile(path_);
  EXPECT_TRUE(loaded.fronts.at(0).model.closed_known);
  EXPECT_NEAR(loaded.fronts[0].model.q_closed, -0.3, 1e-10);
  EXPECT_NEAR(loaded.fronts[0].model.opening, 0.8 / 1.5, 1e-10);
  EXPECT_FALSE(loaded.fronts.at(1).model.closed_known) << "as in a file that is older than the field";
  EXPECT_TRUE(std::isnan(loaded.fronts[1].model.q_closed) && std::isnan(loaded.fronts[1].model.opening));
}

TEST_F(ModelFiles, OlderThanAJointTypeGiveItNoProbability) {
  saveModelFile(path_, {"map", {learned(test::doorModel())}});
  damage("probabilities: [0.01, 0.02, 0.94, 0.03, 0]", "probabilities: [0.01, 0.02, 0.97]");
  damage("    pitch: 0.0125\n", "");
  const LearnedModel loaded = readModelFile(path_).fronts.at(0).model;
  EXPECT_EQ(loaded.probabilities, (std::vector<double>{0.01, 0.02, 0.97, 0, 0}));
  EXPECT_EQ(loaded.pitch, 0);
}

TEST_F(ModelFiles, OlderThanDoubtKnowOfNone) {
  KnownFront door = learned(test::doorModel());
  door.model.doubt = 0.5;
  saveModelFile(path_, {"map", {door}});
  damage("    doubt: 0.5\n", "");
  EXPECT_EQ(readModelFile(path_).fronts.at(0).model.doubt, 0);
}

TEST_F(ModelFiles, OlderThanTheFieldsForSupportAndDoubtHaveThemAmongTheParams) {
  KnownFront door = learned(test::doorModel());
  door.model.support = 40;
  door.model.params.push_back({"support", 17, ModelParam::kEval});
  door.model.params.push_back({"doubt", 0.25, ModelParam::kEval});
  saveModelFile(path_, {"map", {door}});
  ASSERT_NE(text().find("doubt: [0.25, 2]"), std::string::npos);
  const LearnedModel loaded = readModelFile(path_).fronts.at(0).model;
  EXPECT_EQ(loaded.support, 40);
  EXPECT_EQ(loaded.doubt, 0);
  ASSERT_EQ(loaded.params.size(), 2u) << "nobody keeps them up to date there";
  EXPECT_EQ(loaded.params[1].name, "q_min[0]");
}

TEST_F(ModelFiles, OfTheTimeWhenIdsBeganAtZeroGiveThatFrontAnother) {
  saveModelFile(path_, {"map", {learned(test::doorModel()), learned(test::drawerModel())}});
  damage("id: 3", "id: 0");
  const ModelFile loaded = readModelFile(path_);
  EXPECT_EQ(loaded.fronts.at(0).model.id, 5u);
  EXPECT_EQ(loaded.fronts.at(0).track.id, 5u);
  EXPECT_EQ(inWords(loaded.changes), "front 0 of the file is front 5 now");
}

TEST_F(ModelFiles, HoldTimesFromTheFirstToTheLastThatAMessageHolds) {
  for (const double stamp : {0.0, 0.02, 4290000000.0}) {
    saveModelFile(path_, {"map", {learned(test::doorModel(), 20, stamp)}});
    const KnownFront loaded = readModelFile(path_).fronts.at(0);
    EXPECT_NEAR(loaded.model.stamp, stamp, 0.01);
    EXPECT_GE(loaded.track.observations.front().stamp, 0);
    EXPECT_TRUE(std::is_sorted(loaded.track.observations.begin(), loaded.track.observations.end(),
                               [](const auto& a, const auto& b) { return a.stamp < b.stamp; }));
    fs::remove(path_);
  }
}

TEST_F(ModelFiles, OfNothingAreReadToo) {
  saveModelFile(path_, {"map", {}});
  EXPECT_TRUE(readModelFile(path_).fronts.empty());
}

TEST_F(ModelFiles, HoldMarkersThatHaveNoSizeAndObservationsWithoutCertainty) {
  LearnedModel marker = test::drawerModel();
  marker.width = marker.height = 0;
  ModelFile saved{"map", {learned(marker)}};
  for (TrackedObservation& observation : saved.fronts[0].track.observations) observation.rectangle.height = 0;
  saved.fronts[0].track.observations[1].covariance(5, 5) = std::numeric_limits<double>::infinity();
  saved.fronts[0].track.observations[2].rectangle.pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  saveModelFile(path_, saved);
  const KnownFront loaded = readModelFile(path_).fronts.at(0);
  EXPECT_EQ(loaded.model.width, 0);
  ASSERT_EQ(loaded.track.observations.size(), 19u) << "but for the one without a place";
  EXPECT_TRUE(loaded.track.observations[1].covariance.isZero(0)) << "unknown";
}

TEST_F(ModelFiles, StaySmallWhenMuchWasSeen) {
  saveModelFile(path_, {"map", {learned(test::doorModel(), 5000)}});
  EXPECT_LE(readModelFile(path_).fronts.at(0).track.observations.size(), 200u);
  EXPECT_LT(fs::file_size(path_), 200000u);
}

}  // namespace
}  // namespace cabinet_articulation::core
