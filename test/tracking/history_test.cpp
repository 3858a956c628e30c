// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/motion/history.h"

#include <gtest/gtest.h>

#include "tracking/motion/motion_gate.h"
#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

TEST(ThinOut, ForgetsStandingStillAndKeepsTheMotion) {
  std::vector<Rectangle> places(150, closedFront());
  for (int i = 0; i < 50; ++i) places.push_back(pulled(closedFront(), 0.006 * i));
  for (int i = 0; i < 200; ++i) places.push_back(pulled(closedFront(), 0.3));
  auto history = historyOf(places);
  EXPECT_FALSE(thinOut(history, 400));
  EXPECT_EQ(history.size(), 400u);
  EXPECT_TRUE(thinOut(history, 399));
  EXPECT_EQ(history.size(), 400u - 399 / 4);
  int moving = 0;
  for (size_t i = 0; i < history.size(); ++i) {
    EXPECT_TRUE(i == 0 || history[i].stamp > history[i - 1].stamp);
    moving += history[i].stamp > 149.5 * kFrame && history[i].stamp < 199.5 * kFrame;
  }
  EXPECT_EQ(moving, 50);
  EXPECT_EQ(history.back().stamp, 399 * kFrame);
}

}  // namespace
}  // namespace cabinet_articulation::core
