// SPDX-License-Identifier: BSD-3-Clause
// Two cameras at once, one before a door and one before a drawer: each pipeline learns its own, and nothing mixes.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SceneTruth.h>
#include <gtest/gtest.h>
#include <sensor_msgs/JointState.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <set>

#include "ros/messages/simulation_conversions.h"
#include "support/ros_probe.h"
#include "tools/truth/truth_comparison.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

constexpr size_t kAnswers = 30;

/// Everything from one camera and its pipeline.
struct Side {
  explicit Side(const std::string& name)
      : name(name),
        truth("/" + name + "_camera/truth", 1000),
        models("/" + name + "/models", 1000),
        joint_states("/" + name + "/joint_states", 1000) {}

  bool finished() const {
    return !truth.messages.empty() && truth.messages.back()->last && models.messages.size() >= kAnswers &&
           models.messages.back()->header.stamp >= truth.messages.back()->header.stamp;
  }

  SceneComparison comparison() const {
    TruthComparison comparison;
    for (const auto& frame : truth.messages) comparison.add(inFrame(*frame, models.messages.back()->header.frame_id));
    return comparison.compare(models.messages.back()->models, TruthLimits());
  }

  std::set<std::string> joints() const {
    std::set<std::string> names;
    for (const auto& message : joint_states.messages) names.insert(message->name.begin(), message->name.end());
    return names;
  }

  /// By their default names.
  std::set<std::string> frontsThatMoved() const {
    std::set<std::string> names;
    for (const auto& answer : models.messages)
      for (const ArticulationModel& model : answer->models)
        if (model.moved) names.insert("front_" + std::to_string(model.id));
    return names;
  }

  /// The joint that moved, in the newest models.
  const ArticulationModel& moved() const {
    const auto& all = models.messages.back()->models;
    return *std::find_if(all.begin(), all.end(), [](const ArticulationModel& model) { return model.moved; });
  }

  const std::string name;
  const Recorder<SceneTruth> truth;
  const Recorder<ArticulationModelArray> models;
  const Recorder<sensor_msgs::JointState> joint_states;
};

TEST(TwoCameras, LearnTheirOwnAndNothingMixes) {
  const Recorder<tf2_msgs::TFMessage> tf("/tf", 10000);
  const Side kitchen("kitchen"), workshop("workshop");
  ASSERT_TRUE(spinUntil([&] { return kitchen.finished() && workshop.finished(); }, 90))
      << kitchen.models.messages.size() << " and " << workshop.models.messages.size() << " answers";
  for (const Side* side : {&kitchen, &workshop}) {
    const SceneComparison result = side->comparison();
    EXPECT_TRUE(result.right()) << side->name << "\n" << format(result);
    EXPECT_EQ(result.false_movers, 0) << side->name << "\n" << format(result);
    for (const auto& answer : side->models.messages) ASSERT_EQ(answer->header.frame_id, side->name + "_optical");
    ASSERT_FALSE(side->joints().empty()) << side->name;
    for (const std::string& joint : side->joints()) EXPECT_EQ(side->frontsThatMoved().count(joint), 1u) << joint;
  }
  EXPECT_EQ(kitchen.moved().type, ArticulationModel::ROTATIONAL);
  EXPECT_EQ(workshop.moved().type, ArticulationModel::PRISMATIC);

  // Frames of fronts hang from their own camera only.
  std::set<std::string> prefixes;
  for (const auto& message : tf.messages)
    for (const auto& transform : message->transforms) {
      const std::string& child = transform.child_frame_id;
      const std::string prefix = child.substr(0, child.find('_'));
      if (child == prefix + "_optical") continue;
      prefixes.insert(prefix);
      EXPECT_TRUE(transform.header.frame_id == prefix + "_optical" || transform.header.frame_id.rfind(prefix + "_", 0) == 0)
          << transform.header.frame_id << " -> " << child;
    }
  EXPECT_EQ(prefixes, (std::set<std::string>{"kitchen", "workshop"}));

  // The services answer for their own: the same id is another front, or none, next door.
  for (const Side* side : {&kitchen, &workshop}) {
    Predict predict;
    predict.request.id = side->moved().id;
    predict.request.q = {0};
    ASSERT_TRUE(ros::service::call("/" + side->name + "/predict", predict));
    EXPECT_TRUE(predict.response.success) << predict.response.message;
    EXPECT_EQ(predict.response.header.frame_id, side->name + "_optical");
  }
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "two_cameras_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
