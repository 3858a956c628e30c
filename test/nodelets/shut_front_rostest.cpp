// SPDX-License-Identifier: BSD-3-Clause
// That a front is shut outlives the nodelet that saw it shut.
#include <cabinet_articulation/KnownFrontArray.h>
#include <sensor_msgs/JointState.h>

#include <cmath>

#include "support/model_file_fixture.h"
#include "support/wall_view.h"

namespace cabinet_articulation {
namespace {

using test::doorPose;

class ShutFront : public test::ModelFile {
 protected:
  static constexpr double kAjar = 0.15, kOpen = 1.2;  // [rad]

  void SetUp() override {
    ModelFile::SetUp();
    door_ = tracks_[0];
    tracks_.clear();
  }

  /// The door goes to and fro. It is detected while it is ajar at least.
  ArticulationModel move(double from, double to, int frames) {
    for (int i = 0; i < frames; ++i) {
      stamp_ += 1.0 / 15;
      const double q = from + (to - from) * i / (frames - 1);
      view_ = kitchen_.at(doorPose(q), stamp_);
      if (q >= kAjar) observe(&door_, doorPose(q), stamp_);
      if (!door_.observations.empty()) tracks_ = {door_};
      const ArticulationModelArrayConstPtr models = publish(stamp_);
      if (models && !models->models.empty()) last_ = models->models[0];
    }
    return last_;
  }

  const core::Rectangle closed_{doorPose(0), 0.4, 0.6};
  test::WallView kitchen_{closed_, {closed_.pose, 3, 3}};
  core::Track door_;
  double stamp_ = 100;
  ArticulationModel last_;
};

TEST_F(ShutFront, IsKeptInAFile) {
  constexpr int kFrames = 40, kRest = 10;
  move(0, 0, kRest);
  move(0, kOpen, kFrames);
  move(kOpen, 0, kFrames);
  const ArticulationModel shut = move(0, 0, kRest);
  ASSERT_TRUE(shut.closed_known);
  ASSERT_EQ(shut.opening, 0) << "the views show it shut";
  ASSERT_LT(shut.q_closed, -kAjar / 2) << "q counts from the first detection";
  EXPECT_EQ(shut.q_min, shut.q_closed);
  restart();
  EXPECT_TRUE(contains(text(), "q_closed: "));
  const test::Recorder<sensor_msgs::JointState> states("/cabinet/joint_states");
  ASSERT_TRUE(test::spinUntil([&] { return !states.messages.empty(); })) << "who comes late hears where the front was left";
  ASSERT_EQ(states.messages.back()->position.size(), 1U);
  EXPECT_NEAR(states.messages.back()->position[0], shut.q_closed, 1e-6);

  // As a tracker goes on that heard of it.
  const test::Recorder<KnownFrontArray> known("/cabinet/known_fronts");
  ASSERT_TRUE(test::spinUntil([&] { return !known.messages.empty(); }));
  ASSERT_EQ(known.messages.back()->tracks.size(), 1U);
  generation_ = known.messages.back()->generation;
  door_ = wholeTrack(known.messages.back()->tracks[0]);

  // It opens a little, and is learned from anew: the detections alone do not reach to where it was shut.
  const ArticulationModel ajar = move(0.4, 0.5, kRest);
  ASSERT_TRUE(ajar.closed_known);
  EXPECT_NEAR(ajar.q_closed, shut.q_closed, 0.02);
  EXPECT_EQ(ajar.q_min, ajar.q_closed);
  EXPECT_TRUE(ajar.q_min_is_end);
  EXPECT_NEAR(ajar.opening, 0.5 / kOpen, 0.05);
}

/// Joint states are of what a frame shows. That a front is not where it was shut is news, too, though no detector saw it.
TEST_F(ShutFront, IsSentToBeWhereItWasDetectedOnceItsPlaceIsEmpty) {
  constexpr int kFrames = 40, kRest = 10;
  const test::Recorder<sensor_msgs::JointState> states("/cabinet/joint_states");
  move(0, 0, kRest);
  move(0, kOpen, kFrames);
  move(kOpen, 0, kFrames);
  ASSERT_EQ(move(0, 0, kRest).opening, 0);
  ArticulationModel left;
  for (int i = 0; i < kRest; ++i) {
    stamp_ += 1.0 / 15;
    view_ = kitchen_.at(doorPose(M_PI / 2), stamp_);
    const ArticulationModelArrayConstPtr models = publish(stamp_);
    ASSERT_TRUE(models && !models->models.empty());
    left = models->models[0];
  }
  ASSERT_GT(left.opening, 0);
  const auto sent = [&] { return !states.messages.empty() && std::abs(states.messages.back()->position[0] - left.q) < 1e-6; };
  EXPECT_TRUE(test::spinUntil(sent));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "shut_front_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
