// SPDX-License-Identifier: BSD-3-Clause
// The whole pipeline on a simulated scene; end_to_end.test chooses scene and input.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/SceneTruth.h>
#include <gtest/gtest.h>

#include "cabinet_articulation/ros/simulation_conversions.h"
#include "support/ros_probe.h"
#include "truth_comparison.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

// Simulated frames come at 15 Hz; a machine that builds and tests at the same time may leave out half of them.
constexpr double kLeastRate = 5;  // [Hz]
constexpr double kOldest = 1;     // [s]
constexpr size_t kFrames = 60;    // the script of a scene in which nothing moves is short

TEST(EndToEnd, ModelsAreRightAndInTime) {
  const Recorder<SceneTruth> truth("/stereo/truth", 1000);
  const Recorder<ArticulationModelArray> models("/cabinet/models", 1000);
  double oldest = 0;
  size_t seen = 0;
  const auto finished = [&] {
    for (; seen < models.messages.size(); ++seen)
      oldest = std::max(oldest, (ros::Time::now() - models.messages[seen]->header.stamp).toSec());
    return truth.messages.size() >= kFrames && truth.messages.back()->last;
  };
  ASSERT_TRUE(spinUntil(finished, 60)) << truth.messages.size() << " frames, " << models.messages.size() << " answers";
  test::spinFor(0.5);

  ASSERT_FALSE(models.messages.empty());
  TruthComparison comparison;
  for (const auto& frame : truth.messages) comparison.add(inFrame(*frame, models.messages.back()->header.frame_id));
  const SceneComparison result = comparison.compare(models.messages.back()->models, TruthLimits());
  EXPECT_TRUE(result.right()) << format(result);
  EXPECT_EQ(result.false_movers, 0) << format(result);
  const double duration = (truth.messages.back()->header.stamp - models.messages.front()->header.stamp).toSec();
  EXPECT_GT(models.messages.size(), kLeastRate * duration);
  EXPECT_LT(oldest, kOldest) << "frames queue up";
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "end_to_end_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
