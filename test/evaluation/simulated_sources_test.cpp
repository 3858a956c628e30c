// SPDX-License-Identifier: BSD-3-Clause
#include "sources/simulated_sources.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace cabinet_articulation::core::evaluation {
namespace {

TEST(SimulatedSources, TheHangingDrawerIsInView) {
  const auto source = simulateHangingDrawer(8, 1);
  ASSERT_EQ(source->size(), 8);
  EXPECT_TRUE(source->independent());
  for (int i = 0; i < source->size(); ++i) {
    const Front front = source->frame(i).fronts.at(0);
    EXPECT_DOUBLE_EQ(front.in_image, 1);
    // The handle hides some 3 % of the front.
    EXPECT_GT(front.visible, 0.9) << i;
    EXPECT_TRUE(front.faces_camera);
    EXPECT_GT(front.rectangle.center().z(), 0.6);
    EXPECT_LT(front.rectangle.center().z(), 3.0);
  }
}

TEST(SimulatedSources, AFrameDependsOnItsIndexAlone) {
  const auto source = simulateHangingDrawer(3, 1);
  const Frame first = source->frame(2);
  source->frame(0);
  const Frame second = source->frame(2), other = source->frame(1);
  EXPECT_EQ(cv::norm(first.left, second.left, cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(first.left, other.left, cv::NORM_INF), 0);
}

TEST(SimulatedSources, BoardsStandAtTheirDistances) {
  const auto source = simulateBoard("board", 0.8, {0.7, 2.5});
  ASSERT_EQ(source->size(), 2);
  EXPECT_NEAR(source->frame(0).fronts.at(0).rectangle.center().z(), 0.7, 1e-9);
  EXPECT_NEAR(source->frame(1).fronts.at(0).rectangle.center().z(), 2.5, 1e-9);
}

TEST(SimulatedSources, ARunOpensItsFront) {
  SimulationConfig config;
  config.scene = "door";
  config.rate = 1;
  const auto source = simulateRun(config);
  EXPECT_FALSE(source->independent());
  double farthest = 0;
  for (int i = 0; i < source->size(); ++i) farthest = std::max(farthest, source->frame(i).fronts.at(0).opened);
  EXPECT_GT(farthest, 0.3);
  EXPECT_EQ(source->frame(0).fronts.at(0).opened, 0);
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
