// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/pair_watch.h"

#include <gtest/gtest.h>

#include <vector>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace cabinet_articulation::core {
namespace {

/// The simulated kitchen with and without the projector's pattern.
class ProjectorWatchTest : public testing::Test {
 protected:
  ProjectorWatchTest() : lit_(SimulationConfig()), unlit_(withoutPattern()) {}

  static SimulationConfig withoutPattern() {
    SimulationConfig config;
    config.ambient = 2;
    config.pattern_blur = 1;
    config.pattern_cell = 40;
    return config;
  }

  cv::Mat1b image(int frame, bool lit) { return (lit ? lit_ : unlit_).frame(frame).left; }

  SimulatedStereoCamera lit_, unlit_;
  ProjectorWatch watch_;
};

TEST_F(ProjectorWatchTest, FindsTheFramesWithoutThePattern) {
  int found = 0, wrong = 0;
  for (int i = 0; i < 40; ++i) {
    const bool lit = i % 2 == 0;
    const bool lacks = watch_.lacksPattern(image(i, lit));
    if (i >= 8) (lacks == !lit ? found : wrong)++;
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(found, 32);
}

TEST_F(ProjectorWatchTest, FindsThemAlsoWhereTheyAreRarer) {
  int wrong = 0;
  for (int i = 0; i < 40; ++i) {
    const bool lit = i % 3 != 0;
    if (watch_.lacksPattern(image(i, lit)) != !lit && i >= 12) ++wrong;
  }
  EXPECT_EQ(wrong, 0);
}

TEST_F(ProjectorWatchTest, LeavesASteadyProjectorAlone) {
  for (int i = 0; i < lit_.frameCount(); i += 2) EXPECT_FALSE(watch_.lacksPattern(image(i, true))) << i;
}

TEST_F(ProjectorWatchTest, LeavesAProjectorAloneThatIsSwitchedOffOrOn) {
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(watch_.lacksPattern(image(i, i < 10 || i > 20))) << i;
}

TEST_F(ProjectorWatchTest, TellsASwappedPair) {
  const StereoFrame frame = lit_.frame(0);
  BlockMatcher matcher{StereoConfig()};
  EXPECT_TRUE(SwapWatch().looksSwapped(matcher.process(frame.right, frame.left, lit_.camera()), &matcher));
  EXPECT_FALSE(SwapWatch().looksSwapped(matcher.process(frame.left, frame.right, lit_.camera()), &matcher));
}

TEST_F(ProjectorWatchTest, TakesNoPairForSwappedThatShowsNothing) {
  BlockMatcher matcher{StereoConfig()};
  const StereoFrame frame = unlit_.frame(0);
  EXPECT_FALSE(SwapWatch().looksSwapped(matcher.process(frame.left, frame.right, unlit_.camera()), &matcher));
  const cv::Mat1b dark(480, 640, std::uint8_t{3});
  EXPECT_FALSE(SwapWatch().looksSwapped(matcher.process(dark, dark, unlit_.camera()), &matcher));
}

}  // namespace
}  // namespace cabinet_articulation::core
