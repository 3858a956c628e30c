// SPDX-License-Identifier: BSD-3-Clause
// A bag in a loop, with its clock: time jumps back again and again. What lives starts afresh, what was learned stays.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SceneTruth.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>
#include <spawn.h>
#include <sys/wait.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <map>

#include "ros/messages/simulation_conversions.h"
#include "support/ros_probe.h"
#include "tools/input/scene_bag.h"
#include "tools/truth/truth_comparison.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

/// Runs a program until the end of its life.
class Program {
 public:
  explicit Program(std::vector<std::string> arguments) {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    EXPECT_EQ(::posix_spawnp(&pid_, argv[0], nullptr, nullptr, argv.data(), environ), 0) << arguments[0];
  }
  ~Program() {
    ::kill(pid_, SIGINT);
    ::waitpid(pid_, nullptr, 0);
  }

 private:
  pid_t pid_ = 0;
};

/// A drawer is opened and closed, seen by a camera that wanders.
class LoopedBag : public testing::Test {
 protected:
  LoopedBag() : bag_(std::filesystem::temp_directory_path() / ("looped_bag_rostest." + std::to_string(::getpid()) + ".bag")) {
    SceneBagConfig config;
    config.simulation.scene = "drawer";
    config.simulation.hand = false;
    config.simulation.camera_motion = 0.1;
    config.simulation.rate = 10;
    writeSceneBag(bag_.string(), config);
    rosbag::Bag bag(bag_.string());
    for (const rosbag::MessageInstance& instance : rosbag::View(bag))
      if (const auto truth = instance.instantiate<SceneTruth>()) truth_.add(inFrame(*truth, config.world_frame));
  }

  ~LoopedBag() override { std::filesystem::remove(bag_); }

  std::filesystem::path bag_;
  TruthComparison truth_;
};

/// Messages cut into rounds where their stamps jump back.
template <class Message>
std::vector<std::vector<boost::shared_ptr<const Message>>> rounds(const Recorder<Message>& recorder) {
  std::vector<std::vector<boost::shared_ptr<const Message>>> result;
  ros::Time last;
  for (const auto& message : recorder.messages) {
    if (result.empty() || message->header.stamp < last) result.emplace_back();
    result.back().push_back(message);
    last = message->header.stamp;
  }
  return result;
}

TEST_F(LoopedBag, TimeThatJumpsBackResetsWhatLivesAndKeepsWhatWasLearned) {
  const test::Reports reports;
  const Recorder<TrackArray> tracks("/cabinet/tracks", 1000);
  const Recorder<ArticulationModelArray> models("/cabinet/models", 1000);
  const Recorder<sensor_msgs::JointState> joint_states("/cabinet/joint_states", 1000);
  const Recorder<tf2_msgs::TFMessage> tf("/tf", 1000);
  ASSERT_TRUE(spinUntil([&] { return models.connected() && tracks.connected() && joint_states.connected(); }));
  {
    const Program player({"rosrun", "rosbag", "play", "--loop", "--clock", "--quiet", bag_.string()});
    ASSERT_TRUE(spinUntil([&] { return rounds(models).size() == 4; }, 150)) << rounds(models).size() << " rounds";
  }

  // The first round may begin in its middle; the fourth has only begun.
  std::uint32_t drawer = 0;
  for (int i = 0; i < 3; ++i) {
    SCOPED_TRACE("round " + std::to_string(i));
    const auto round = rounds(models).at(i);
    EXPECT_GT(round.size(), 20u);
    const SceneComparison result = truth_.compare(round.back()->models, TruthLimits());
    EXPECT_TRUE(result.right()) << format(result);
    EXPECT_EQ(result.false_movers, 0) << format(result);
    ASSERT_EQ(result.joints.size(), 1u);
    if (i == 0) drawer = result.joints[0].model.id;
    EXPECT_EQ(result.joints[0].model.id, drawer) << "what was learned keeps its name";
    const auto states = rounds(joint_states).at(i);
    for (const auto& state : states)
      for (const std::string& name : state->name) EXPECT_EQ(name, "front_" + std::to_string(drawer));
    const auto frames = rounds(tracks).at(i);
    for (const auto& frame : frames)
      for (const Track& track : frame->tracks) EXPECT_LE(track.stamps.back(), frame->header.stamp) << "lives in the future";
  }

  // A frame's stamps grow, but for the three jumps, and are sent again after each.
  std::map<std::string, std::vector<ros::Time>> stamps;
  for (const auto& message : tf.messages)
    for (const auto& transform : message->transforms) stamps[transform.child_frame_id].push_back(transform.header.stamp);
  for (const std::string part : {"base", "front"}) {
    const auto& sent = stamps["cabinet_" + std::to_string(drawer) + "_" + part];
    int jumps = 0;
    for (size_t i = 1; i < sent.size(); ++i) {
      EXPECT_NE(sent[i], sent[i - 1]) << part;
      jumps += sent[i] < sent[i - 1];
    }
    EXPECT_GE(jumps, 2) << part;
    EXPECT_LE(jumps, 3) << part;
  }

  Predict predict;
  predict.request.id = drawer;
  predict.request.q = {0.1};
  ASSERT_TRUE(ros::service::call("/cabinet/predict", predict));
  EXPECT_TRUE(predict.response.success) << predict.response.message;
  for (const std::string words : {"time jumped back; all tracks are forgotten", "time jumped back; joints stay known"})
    EXPECT_TRUE(reports.logged(rosgraph_msgs::Log::WARN, words)) << words;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "looped_bag_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
