// SPDX-License-Identifier: BSD-3-Clause
// The pure functions of the bridge, against ground truth by the original release's own formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bridge/original_learner.h"
#include "bridge/original_model.h"
#include "bridge/original_params.h"
#include "bridge/spanning_tree.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "original_paths.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::ArticulatedObjectMsg;
using articulation_msgs::ModelMsg;
using articulation_msgs::TrackMsg;

ModelMsg requestOf(const TrackMsg& track, const std::string& name = "") {
  ModelMsg request;
  request.name = name;
  request.track = track;
  return request;
}

template <class Work>
std::string refusal(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

OriginalLearner learner() {
  core::ArticulationConfig config;
  config.joint_types = "rigid prismatic rotational";
  return OriginalLearner(config);
}

TEST(OriginalLearner, SelectsTheTrueTypeAndDescribesItAsTheOriginalWould) {
  const ModelMsg door = learner().select(requestOf(trackOf(turned, 1.2)));
  ASSERT_EQ(door.name, "rotational");
  EXPECT_EQ(door.id, -1);
  for (const double q : {0.0, 0.6, 1.2}) {
    const Eigen::Isometry3d error = turned(q).inverse() * originalTurn(door.params, q);
    EXPECT_LT(error.translation().norm(), 0.005) << q;
    EXPECT_LT(Eigen::AngleAxisd(error.linear()).angle(), 0.01) << q;
  }
  EXPECT_NEAR(requireParam(door.params, "q_max[0]") - requireParam(door.params, "q_min[0]"), 1.2, 0.02);
  ASSERT_EQ(door.track.pose_projected.size(), door.track.pose.size());
  EXPECT_NEAR(channel("q0", const_cast<TrackMsg*>(&door.track)).back(), 1.2, 0.02);
  EXPECT_EQ(door.track.pose_resampled.size(), 25U) << "every 0.05 rad";
  EXPECT_LT(requireParam(door.params, "avg_error_position"), 0.003);

  const ModelMsg drawer = learner().select(requestOf(trackOf(pulled, 0.3)));
  ASSERT_EQ(drawer.name, "prismatic");
  EXPECT_NEAR(requireVector(drawer.params, "prismatic_dir").z(), -1, 0.01);
  EXPECT_LT((requireVector(drawer.params, "rigid_position") - kDoor.translation()).norm(), 0.003);
  EXPECT_EQ(learner().select(requestOf(trackOf(pulled, 0))).name, "rigid");
}

TEST(OriginalLearner, CornersOfRectanglesComeBackAsCorners) {
  // The corner lies 0.1 m from the axis, the centre 0.3 m.
  const Eigen::Isometry3d corner(Eigen::Translation3d(0.1, 0, 0));
  const auto at = [&](double q) { return Eigen::Isometry3d(Eigen::AngleAxisd(q, Eigen::Vector3d::UnitY()) * corner); };
  TrackMsg track = trackOf(at, 1.2);
  channel("width", &track).assign(kPoses, 0.4F);
  channel("height", &track).assign(kPoses, 0.6F);
  EXPECT_NEAR(fromOriginal(track).track.observations[0].rectangle.center().x(), 0.3, 0.005);
  const ModelMsg door = learner().select(requestOf(track));
  ASSERT_EQ(door.name, "rotational");
  EXPECT_NEAR(requireParam(door.params, "rot_radius"), 0.1, 0.005);
  for (const double q : {0.0, 1.2})
    EXPECT_LT((originalTurn(door.params, q).translation() - at(q).translation()).norm(), 0.006) << q;
  const TrackMsg back = toOriginal(fromOriginal(track).track, "map");
  EXPECT_TRUE(fromMessage(back.pose[7]).isApprox(fromMessage(track.pose[7]), 1e-6));
}

TEST(OriginalLearner, ModelsGoBackAndForth) {
  for (const char* name : {"rigid", "prismatic", "rotational", "screw"}) {
    const TrackMsg track = name[0] == 'p' ? trackOf(pulled, 0.3) : trackOf(turned, 1.2);
    const ModelMsg fitted = learner().fit(requestOf(track, name));
    ASSERT_EQ(fitted.name, name);
    const ModelMsg evaluated = learner().eval(fitted);
    EXPECT_NEAR(requireParam(evaluated.params, "loglikelihood"), requireParam(fitted.params, "loglikelihood"), 0.01) << name;
    for (int i = 0; i < kPoses; ++i)
      EXPECT_TRUE(fromMessage(evaluated.track.pose_projected[i]).isApprox(fromMessage(fitted.track.pose_projected[i]), 1e-5));
  }
}

TEST(OriginalLearner, ProjectsBothWays) {
  ModelMsg model = learner().fit(requestOf(trackOf(pulled, 0.3, 0), "prismatic"));
  model.track.channels.clear();
  ModelMsg q = learner().posesToConfigurations(model);
  EXPECT_NEAR(channel("q0", &q.track)[kPoses - 1], 0.3, 1e-4);
  q.track.pose_projected.clear();
  const ModelMsg poses = learner().configurationsToPoses(q);
  EXPECT_TRUE(fromMessage(poses.track.pose_projected.at(kPoses - 1)).isApprox(pulled(0.3), 1e-4));
  EXPECT_EQ(refusal([&] { learner().configurationsToPoses(model); }), "the track has no channel 'q0'");
}

TEST(OriginalLearner, TakesATrackIntoAStoredModelOfTheSamePath) {
  OriginalLearner learner = bridge::learner();
  const ModelMsg stored = learner.store(learner.select(requestOf(trackOf(turned, 1.2))));
  EXPECT_EQ(stored.id, 0);
  EXPECT_EQ(learner.store(learner.select(requestOf(trackOf(pulled, 0.3)))).id, 1);
  const ModelMsg again = learner.select(requestOf(trackOf(turned, 0.8)));
  EXPECT_EQ(again.id, 0) << "the same door";
  EXPECT_EQ(again.track.pose.size(), 2U * kPoses);
  const auto elsewhere = [](double q) { return Eigen::Isometry3d(Eigen::Translation3d(2, 0, 0) * turned(q)); };
  EXPECT_EQ(learner.select(requestOf(trackOf(elsewhere, 0.8))).id, -1) << "another door";
  ASSERT_EQ(learner.prior().size(), 2U);

  OriginalLearner other = bridge::learner();
  other.setPrior(learner.prior());
  EXPECT_EQ(other.prior().size(), 2U);
  EXPECT_NE(refusal([&] { other.setPrior({stored, stored}); }).find("model[1]: id 0 is there twice"), std::string::npos);
  EXPECT_EQ(other.prior().size(), 2U) << "a refusal changes nothing";
}

TEST(OriginalLearner, AStoredModelIsComparedByTheSettingsOfTheRequest) {
  OriginalLearner learner = bridge::learner();
  learner.store(learner.select(requestOf(trackOf(turned, 1.2))));
  for (const double sigma : {0.002, 0.05}) {
    ModelMsg request = requestOf(trackOf(turned, 0.8));
    setParam("sigma_position", sigma, 0, &request.params);
    EXPECT_EQ(learner.select(request).id, 0) << "the same door, with " << sigma << " m of noise instead of 0.01 m";
  }
}

TEST(OriginalLearner, GivesTheFirstFreeId) {
  OriginalLearner learner = bridge::learner();
  ModelMsg model = learner.select(requestOf(trackOf(turned, 1.2)));
  model.id = std::numeric_limits<int>::max();
  learner.store(model);
  model.id = -1;
  EXPECT_EQ(learner.store(model).id, 0);
  EXPECT_EQ(learner.store(model).id, 1);
}

TEST(OriginalLearner, RefusesWhatWouldTakeLong) {
  OriginalLearner learner = bridge::learner();
  ModelMsg model = learner.select(requestOf(trackOf(turned, 1.2)));
  TrackMsg track = trackOf(turned, 0.8);
  track.pose.resize(10000, track.pose.back());
  for (std::size_t i = 0; i <= kMostFittedPoses / track.pose.size(); ++i) learner.store(model);
  EXPECT_NE(refusal([&] { learner.select(requestOf(track)); }).find("stored models would take fits to"), std::string::npos);
  ArticulatedObjectMsg object;
  object.parts.assign(20, track);
  EXPECT_EQ(refusal([&] { spanningTree(object, {}); }).find("190 pairs of parts would take fits to 1900000 poses"), 0U);
}

TEST(OriginalLearner, KeepsNoMoreThanFits) {
  OriginalLearner learner = bridge::learner();
  ModelMsg model = learner.select(requestOf(trackOf(turned, 1.2)));
  model.track.pose_resampled.resize(1000000);  // 56 MB
  EXPECT_EQ(learner.store(model).id, 0);
  EXPECT_NE(refusal([&] { learner.store(model); }).find("bytes in stored models, expected 67108864 at most"), std::string::npos);
  model.id = 0;
  EXPECT_EQ(learner.store(model).id, 0) << "in its own place";
  learner.setPrior({});
  model.id = -1;
  EXPECT_EQ(learner.store(model).id, 0);
}

TEST(OriginalLearner, ParametersOfTheRequestCount) {
  ModelMsg request = requestOf(trackOf(turned, 1.2));
  setParam("disable_all", 1, 0, &request.params);
  setParam("enable_prismatic", 1, 0, &request.params);
  EXPECT_EQ(learner().select(request).name, "prismatic");
  setParam("sigma_position", -1, 0, &request.params);
  EXPECT_NE(refusal([&] { learner().select(request); }).find("sigma_position"), std::string::npos);
}

TEST(OriginalLearner, RefusalsSayWhy) {
  EXPECT_EQ(refusal([] { learner().select({}); }), "the track has no poses");
  ModelMsg request = requestOf(trackOf(turned, 1.2), "pca_gp");
  EXPECT_NE(refusal([&] { learner().eval(request); }).find("the model is called 'pca_gp', expected one of rigid"),
            std::string::npos);
  request.name = "rotational";
  EXPECT_EQ(refusal([&] { learner().eval(request); }), "param 'rot_axis.x' is missing");
  request.track.channels.resize(1);
  request.track.channels[0].name = "width";
  EXPECT_EQ(refusal([&] { learner().eval(request); }), "channel 'width' has 0 values for 40 poses");
  request.track.pose[3].position.x = std::nan("");
  EXPECT_NE(refusal([&] { learner().fit(request); }), "");
  ModelMsg few = learner().fit(requestOf(trackOf(pulled, 0.3), "prismatic"));
  setParam("resample_density", 1e-9, 0, &few.params);
  EXPECT_NE(refusal([&] { learner().resampled(few); }).find("resample_density"), std::string::npos);
}

TEST(SpanningTree, FindsADoorOnACabinetAndAFlapOnTheDoor) {
  const auto flap = [](double q) { return Eigen::Isometry3d(turned(q) * Eigen::Translation3d(0.1, 0.3 * q, 0)); };
  ArticulatedObjectMsg object;
  object.parts = {trackOf(pulled, 0), trackOf(flap, 1.2), trackOf(turned, 1.2)};
  core::ArticulationConfig config;
  config.joint_types = "rigid prismatic rotational";
  const ArticulatedObjectMsg tree = spanningTree(object, config);
  ASSERT_EQ(tree.models.size(), 2U);
  EXPECT_EQ(tree.models[0].id, 0 * 3 + 2) << "the door hangs on the cabinet";
  EXPECT_EQ(tree.models[0].name, "rotational");
  EXPECT_EQ(tree.models[1].id, 1 * 3 + 2) << "the flap slides on the door";
  EXPECT_EQ(tree.models[1].name, "prismatic");
  EXPECT_EQ(requireParam(tree.params, "spanningtree.dof"), 2);
  for (const TrackMsg& part : tree.parts) {
    ASSERT_EQ(part.pose_projected.size(), part.pose.size());
    for (int i = 0; i < kPoses; ++i)
      EXPECT_LT((fromMessage(part.pose_projected[i]).translation() - fromMessage(part.pose[i]).translation()).norm(), 0.01);
  }
  object.parts[1].pose.pop_back();
  EXPECT_EQ(refusal([&] { spanningTree(object, config); }), "the parts have 40 and 39 poses, expected as many of each");
  object.parts.resize(1);
  EXPECT_NE(refusal([&] { spanningTree(object, config); }).find("number of parts is 1, expected 2 to 20"), std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation::bridge
