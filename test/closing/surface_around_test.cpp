// SPDX-License-Identifier: BSD-3-Clause
#include "closing/surface_around.h"

#include <gtest/gtest.h>

#include <vector>

#include "cabinet_articulation/joints/joint.h"
#include "closing/closed_search.h"
#include "support/models.h"
#include "support/wall_view.h"

namespace cabinet_articulation::core {
namespace {

/// Of a drawer's surface, from so many views at this rate.
double sigmaOf(int count, double rate) {
  const LearnedModel drawer = test::drawerModel();
  test::WallView kitchen(frontAt(drawer, 0), {drawer.predict(0), 3, 3});
  kitchen.noise = 0.01;
  FrontHistory history;
  addSighting(drawer, 0.2, kitchen.at(drawer.predict(0.2), 0), &history);
  std::vector<DepthView> views;
  for (int i = 0; i < count; ++i) views.push_back(kitchen.at(drawer.predict(0), i / rate));
  std::vector<const DepthView*> all;
  for (const DepthView& view : views) all.push_back(&view);
  const std::optional<Surface> surface = surfaceAround(drawer, history.edges, 0, all);
  EXPECT_TRUE(surface);
  return surface ? surface->sigma : 0;
}

TEST(SurfaceAround, IsNotMoreCertainForMoreViewsOfOneSecond) {
  const double once = sigmaOf(1, 1);
  EXPECT_GT(once, 0);
  EXPECT_NEAR(sigmaOf(30, 60), once, 0.2 * once);
  EXPECT_NEAR(sigmaOf(9, 0.5), once / 3, 0.1 * once);
}

}  // namespace
}  // namespace cabinet_articulation::core
