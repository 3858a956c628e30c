// SPDX-License-Identifier: BSD-3-Clause
// The pipeline's models in the original release's messages.
#include "bridge/live_models.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "bridge/original_params.h"
#include "bridge/original_track.h"
#include "cabinet_articulation/ros/conversions.h"
#include "original_paths.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::ModelMsg;

/// As the pipeline publishes them.
ArticulationModelArray modelsOf(const std::vector<core::LearnedModel>& models) {
  std_msgs::Header header;
  header.frame_id = "map";
  return toMessage(models, header);
}

core::LearnedModel hinged(std::uint32_t id) {
  core::LearnedModel door;
  door.id = id;
  door.type = core::JointType::kRotational;
  door.moved = true;
  door.axis = Eigen::Vector3d::UnitY();
  door.origin = kDoor;
  door.axis_point = {0, kDoor.translation().y(), 0};
  door.radius = std::hypot(kDoor.translation().x(), kDoor.translation().z());
  door.q_max = 1.2;
  return door;
}

core::Track trackOfFront(std::uint32_t id, const std::function<Eigen::Isometry3d(double)>& poseAt) {
  core::Track track = fromOriginal(trackOf(poseAt, 1.2, 0)).track;
  track.id = id;
  return track;
}

TEST(LiveModels, AFrontThatIsMerelyExpectedToBeADoorIsRigid) {
  core::LearnedModel expected = hinged(4);
  expected.moved = false;
  expected.observed = false;
  std::string left_out;
  const std::vector<core::Track> tracks{trackOfFront(4, [](double) { return kDoor; })};
  const std::vector<ModelMsg> models = originalModels(modelsOf({expected}), tracks, &left_out);
  ASSERT_EQ(models.size(), 1U) << left_out;
  EXPECT_EQ(models[0].name, "rigid");
  EXPECT_LT((requireVector(models[0].params, "rigid_position") - kDoor.translation()).norm(), 1e-6);
  EXPECT_LT(requireParam(models[0].params, "avg_error_position"), 1e-6);
}

TEST(LiveModels, AFrontThatHangsOnAnotherIsDescribedInTheFrameOfTheMessage) {
  core::LearnedModel door = hinged(4);
  door.q = 0.7;
  core::LearnedModel flap = hinged(5);
  flap.parent = 4;
  // The door rests at 0.7 while the flap turns.
  const auto inTheWorld = [&](double q) { return Eigen::Isometry3d(door.predict(0.7) * flap.predict(q)); };
  std::string left_out;
  const std::vector<core::Track> tracks{trackOfFront(5, inTheWorld)};
  const std::vector<ModelMsg> models = originalModels(modelsOf({door, flap}), tracks, &left_out);
  ASSERT_EQ(models.size(), 1U) << left_out;
  EXPECT_EQ(models[0].name, "rotational");
  for (const double q : {0.0, 1.2}) EXPECT_TRUE(originalTurn(models[0].params, q).isApprox(inTheWorld(q), 1e-6)) << q;
  EXPECT_LT(requireParam(models[0].params, "avg_error_position"), 1e-6);
}

TEST(LiveModels, OnlyTheBadOneIsLeftOut) {
  ArticulationModelArray message = modelsOf({hinged(4), hinged(5), hinged(6)});
  message.models[0].axis.x = message.models[0].axis.y = message.models[0].axis.z = 0;
  message.models[1].q = std::nan("");
  std::vector<core::Track> tracks;
  for (const std::uint32_t id : {4, 5, 6}) tracks.push_back(trackOfFront(id, turned));
  std::string left_out;
  const std::vector<ModelMsg> models = originalModels(message, tracks, &left_out);
  ASSERT_EQ(models.size(), 1U);
  EXPECT_EQ(models[0].id, 6);
  EXPECT_NE(left_out, "");
}

}  // namespace
}  // namespace cabinet_articulation::bridge
