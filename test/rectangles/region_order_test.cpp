// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/region_order.h"

#include <gtest/gtest.h>

#include "front_scene.h"

namespace cabinet_articulation::core {
namespace {

class RegionOrderTest : public testing::Test {
 protected:
  RegionOrderTest() {
    for (const Rectangle& front : fronts_) regions_.push_back(finishRegion(frontRegion(front, camera_)));
  }

  const StereoCamera camera_ = exampleCamera();
  const std::vector<Rectangle> fronts_{exampleFront({-0.3, 0, 1.3}, 0.2, 0.1, 0, 0, 0),
                                       exampleFront({0, 0, 1.3}, 0.2, 0.2, 0, 0, 0),
                                       exampleFront({0.3, 0, 1.3}, 0.2, 0.3, 0, 0, 0)};
  std::vector<PlaneRegion> regions_;
};

TEST_F(RegionOrderTest, LargeOnesFirst) { EXPECT_EQ(regionOrder(regions_, camera_, {}), (std::vector<int>{2, 1, 0})); }

TEST_F(RegionOrderTest, TrackedOnesBeforeThem) {
  EXPECT_EQ(regionOrder(regions_, camera_, {fronts_[0]}), (std::vector<int>{0, 2, 1}));
  EXPECT_EQ(regionOrder(regions_, camera_, {fronts_[0], fronts_[1]}), (std::vector<int>{1, 0, 2}));
}

TEST_F(RegionOrderTest, ATrackElsewhereDoesNotCount) {
  EXPECT_EQ(regionOrder(regions_, camera_, {exampleFront({-0.3, 0, 1.6}, 0.2, 0.1, 0, 0, 0)}), (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(regionOrder(regions_, camera_, {exampleFront({-0.3, 0, -1.3}, 0.2, 0.1, 0, 0, 0)}), (std::vector<int>{2, 1, 0}));
  EXPECT_TRUE(regionOrder({}, camera_, {fronts_[0]}).empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
