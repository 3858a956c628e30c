// SPDX-License-Identifier: BSD-3-Clause
#include "closing/view_memory.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core {
namespace {

DepthView viewAt(double stamp) {
  DepthView view;
  view.stamp = stamp;
  view.columns = view.rows = 1;
  view.depth = {1};
  return view;
}

TEST(ViewMemory, KeepsTheFirstAndTheNewestViewsAndIsBounded) {
  ViewMemory memory;
  constexpr double kRate = 15, kHour = 3600;
  for (int i = 0; i < kRate * kHour; ++i) memory.add(viewAt(i / kRate));
  const std::vector<DepthView>& views = memory.views();
  ASSERT_EQ(views.size(), ViewMemory::kMostViews);
  EXPECT_EQ(views.front().stamp, 0);
  for (std::size_t i = 1; i < views.size(); ++i) {
    EXPECT_GT(views[i].stamp, views[i - 1].stamp);
    const double age = kHour - views[i].stamp;
    EXPECT_LT(views[i].stamp - views[i - 1].stamp, 1 / kRate + 0.8 * (age + views[i].stamp - views[i - 1].stamp))
        << "gaps grow with the age, at " << views[i].stamp;
  }
  EXPECT_NEAR(views[views.size() - 4].stamp, kHour, 4.5 / kRate) << "the newest are all there";
}

TEST(ViewMemory, StartsAnewWhenTimeIsSetBack) {
  ViewMemory memory;
  memory.add(viewAt(5));
  memory.add(viewAt(6));
  memory.add(viewAt(2));
  ASSERT_EQ(memory.views().size(), 1u);
  EXPECT_EQ(memory.views()[0].stamp, 2);
  memory.add(DepthView());
  EXPECT_EQ(memory.views().size(), 1u) << "nothing was seen";
  memory.add(viewAt(3));
  memory.add(viewAt(3));
  EXPECT_EQ(memory.views().size(), 2u) << "sent twice";
  EXPECT_TRUE(memory.has(3));
  EXPECT_FALSE(memory.has(5)) << "forgotten";
}

}  // namespace
}  // namespace cabinet_articulation::core
