// SPDX-License-Identifier: BSD-3-Clause
// The whole pipeline on a simulated scene; end_to_end.test chooses scene and input.
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/SceneTruth.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "ros/messages/simulation_conversions.h"
#include "support/ros_probe.h"
#include "tools/truth/truth_comparison.h"

namespace cabinet_articulation {
namespace {

using test::Recorder;
using test::spinUntil;

// Counts instead of rates: a busy machine leaves out frames, and must be right all the same.
constexpr size_t kOffered = 60;   // frames; the script of a scene in which nothing moves is short
constexpr size_t kAnswered = 30;  // the paper's number of observations for the right type
// A frame in work and one that waits in each of seven nodelets. Frames that queue up would be more.
constexpr long kOnTheWay = 14;

TEST(EndToEnd, ModelsAreRightAndInTime) {
  const Recorder<SceneTruth> truth("/stereo/truth", 1000);
  const Recorder<ArticulationModelArray> models("/cabinet/models", 1000);
  const auto finished = [&] {
    return truth.messages.size() >= kOffered && truth.messages.back()->last && models.messages.size() >= kAnswered;
  };
  ASSERT_TRUE(spinUntil(finished, 60)) << truth.messages.size() << " frames, " << models.messages.size() << " answers";
  const ros::Time last = truth.messages.back()->header.stamp;
  const size_t answers = models.messages.size();
  ASSERT_TRUE(spinUntil([&] { return models.messages.back()->header.stamp >= last; })) << "the newest frame is not answered";
  const auto is_late = [&](const auto& answer) { return answer->header.stamp <= last; };
  EXPECT_LE(std::count_if(models.messages.begin() + static_cast<long>(answers), models.messages.end(), is_late), kOnTheWay)
      << "frames queue up";

  TruthComparison comparison;
  for (const auto& frame : truth.messages) comparison.add(inFrame(*frame, models.messages.back()->header.frame_id));
  const SceneComparison result = comparison.compare(models.messages.back()->models, TruthLimits());
  EXPECT_TRUE(result.right()) << format(result);
  EXPECT_EQ(result.false_movers, 0) << format(result);
  for (size_t i = 1; i < models.messages.size(); ++i)
    EXPECT_GT(models.messages[i]->header.stamp, models.messages[i - 1]->header.stamp) << i;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "end_to_end_rostest");
  ros::NodeHandle keep_alive;
  return RUN_ALL_TESTS();
}
