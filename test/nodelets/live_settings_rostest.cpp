// SPDX-License-Identifier: BSD-3-Clause
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>

#include "support/moving_fronts.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

class LiveSettings : public test::MovingFronts {
 protected:
  LiveSettings() : MovingFronts("cabinet") {}

  /// What is in force after asking for this.
  int setObservationsMin(int value) {
    dynamic_reconfigure::Reconfigure call;
    call.request.config.ints.resize(1);
    call.request.config.ints[0].name = "observations_min";
    call.request.config.ints[0].value = value;
    EXPECT_TRUE(ros::service::waitForService("/cabinet/articulation/set_parameters", ros::Duration(test::kGenerous)));
    EXPECT_TRUE(ros::service::call("/cabinet/articulation/set_parameters", call));
    for (const auto& parameter : call.response.config.ints)
      if (parameter.name == "observations_min") return parameter.value;
    return -1;
  }

  int onServer() const {
    int value = -1;
    ros::param::get("/cabinet/articulation/observations_min", value);
    return value;
  }

  test::Reports reports_;
};

TEST_F(LiveSettings, ChangeWhatIsLearnedWhileItRuns) {
  const Recorder<dynamic_reconfigure::ConfigDescription> description("/cabinet/articulation/parameter_descriptions");
  ASSERT_TRUE(spinUntil([&] { return !description.messages.empty(); }));
  EXPECT_GT(description.messages[0]->groups.at(0).parameters.size(), 10u);
  const ArticulationModelArrayConstPtr models = play(100);
  ASSERT_TRUE(models);
  EXPECT_TRUE(models->models[0].moved);

  EXPECT_EQ(setObservationsMin(1000), 1000);
  EXPECT_EQ(onServer(), 1000);
  const double stamp = 100 + test::kFrames / 15.0;
  observe(&tracks_[0], test::doorPose(1.4), stamp);
  const ArticulationModelArrayConstPtr known = publish(stamp);
  ASSERT_TRUE(known);
  EXPECT_TRUE(known->models[0].moved) << "what is established stays";
  for (core::Track& track : tracks_) {
    track.id = nextId();
    track.observations.clear();
  }
  const ArticulationModelArrayConstPtr strict = play(200);
  ASSERT_TRUE(strict);
  EXPECT_FALSE(strict->models[0].moved) << "1000 observations are asked for";
}

TEST_F(LiveSettings, OutOfRangeAreRefusedInWords) {
  ASSERT_TRUE(spinUntil([&] { return reports_.hears(2); }));
  EXPECT_EQ(setObservationsMin(7), 7);
  EXPECT_EQ(setObservationsMin(-5), 7);
  EXPECT_EQ(onServer(), 7);
  EXPECT_TRUE(
      spinUntil([&] { return reports_.logged(rosgraph_msgs::Log::WARN, "setting 'observations_min' is -5, allowed is"); }));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "live_settings_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
