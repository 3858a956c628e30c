// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/edge_support.h"

#include <gtest/gtest.h>

#include "front_scene.h"
#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {
namespace {

/// A fronto-parallel front whose image is 212 x 159 px about (318, 243); x points right, y up.
class EdgeSupportTest : public testing::Test {
 protected:
  std::array<float, 4> support(const std::array<bool, 4>& confirmed = {}) const {
    const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, {318, 243});
    return edgeSupport(chart, chart.fromSpace(front_), region_.mask, confirmed);
  }
  void paint(const cv::Rect& where, Label label) { region_.mask(where).setTo(label); }

  const StereoCamera camera_ = exampleCamera();
  const Rectangle front_ = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  PlaneRegion region_ = frontRegion(front_, camera_);
  const cv::Rect beyond_right_{425, 0, 640 - 425, 480};  ///< from the front's right edge on
};

TEST_F(EdgeSupportTest, EdgesBeforeAFreeBackgroundAreFullyObserved) {
  for (const float share : support()) EXPECT_EQ(share, 1);
}

TEST_F(EdgeSupportTest, WhatHidesAnEdgeDoesNotSupportIt) {
  paint({200, 100, 80, 300}, kOccluded);  // 68 of the 212 px of the upper and lower edge, and the whole left edge
  const auto share = support();
  EXPECT_EQ(share[kEdgeMinusX], 0);
  EXPECT_EQ(share[kEdgePlusX], 1);
  EXPECT_NEAR(share[kEdgeMinusY], 1 - 68 / 212.0, 2 / 32.0);  // 32 samples
  EXPECT_NEAR(share[kEdgePlusY], 1 - 68 / 212.0, 2 / 32.0);
}

TEST_F(EdgeSupportTest, ANeighbourInFrontHidesWhereTheFrontEnds) {
  paint(beyond_right_, kOccluded);
  EXPECT_EQ(support()[kEdgePlusX], 0);
  paint({425, 0, 6, 480}, kOtherPlane);  // as at a door's hinge: the neighbour's plane passes through the door's
  EXPECT_EQ(support()[kEdgePlusX], 0);
}

TEST_F(EdgeSupportTest, AContinuingSurfaceIsNoEdgeUnlessTheImagesSaySo) {
  paint(beyond_right_, kInPlane);
  EXPECT_EQ(support()[kEdgePlusX], 0);
  EXPECT_EQ(support({false, true, false, false})[kEdgePlusX], 1);
}

TEST_F(EdgeSupportTest, MissingDepthCountsHalfAndOtherRegionsAQuarter) {
  paint(beyond_right_, kUnknown);
  EXPECT_EQ(support()[kEdgePlusX], 0.5F);
  paint(beyond_right_, kOtherPlane);
  EXPECT_EQ(support()[kEdgePlusX], 0.25F);
  paint({425, 0, 8, 480}, kUnknown);  // the shadow of stereo beside a front
  paint({433, 0, 640 - 433, 480}, kFree);
  EXPECT_EQ(support()[kEdgePlusX], 1);
}

TEST_F(EdgeSupportTest, AnEdgeThatMayGoOnBehindItsNeighbourCountsLessTheFartherItMay) {
  paint(beyond_right_, kOtherPlane);
  const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, {318, 243});
  float before = 1;
  for (const double hidden : {0.001, 0.004, 0.008}) {
    const auto share = edgeSupport(chart, chart.fromSpace(front_), region_.mask, {}, {{{}, hidden, {}, {}}});
    EXPECT_LT(share[kEdgePlusX], before) << hidden;
    EXPECT_GT(share[kEdgePlusX], 0) << hidden;
    EXPECT_EQ(share[kEdgeMinusX], 1);
    before = share[kEdgePlusX];
  }
  const auto lost = edgeSupport(chart, chart.fromSpace(front_), region_.mask, {}, {{{}, 0.02, {}, {}}});
  EXPECT_EQ(lost[kEdgePlusX], 0);
}

TEST_F(EdgeSupportTest, BlockMatchingMayCarryTheFrontAFewPixelsOutward) {
  paint({425, 0, 8, 480}, kInPlane);
  EXPECT_EQ(support()[kEdgePlusX], 1);
}

TEST_F(EdgeSupportTest, TheImageBorderIsNoEdge) {
  const Rectangle cut = exampleFront({0.55, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  const PlaneChart chart = *PlaneChart::at(cut.plane(), camera_, {600, 243});
  const auto share = edgeSupport(chart, chart.fromSpace(cut), frontRegion(cut, camera_).mask);
  EXPECT_EQ(share[kEdgePlusX], 0);
  EXPECT_EQ(share[kEdgeMinusX], 1);
  // From 504 px to the image's border at 640: 64 % of the front's 212 px.
  EXPECT_NEAR(share[kEdgeMinusY], 0.64, 0.05);
}

TEST_F(EdgeSupportTest, TheImageCutsWhatItDoesNotShow) {
  const auto cutOf = [this](const Rectangle& front) {
    const PlaneChart chart = *PlaneChart::at(front.plane(), camera_, {318, 243});
    return cutEdges(chart, chart.fromSpace(front), {camera_.width, camera_.height});
  };
  EXPECT_EQ(cutOf(front_), (std::array<bool, 4>{}));
  EXPECT_EQ(cutOf(exampleFront({0, 0, 1.3}, 0.4, 1.2, 0, 0, 0)), (std::array<bool, 4>{false, false, true, true}));
  const auto cut = cutOf(exampleFront({0.4, 0, 1.3}, 0.5, 0.3, 0, 0, 0));
  EXPECT_TRUE(cut[kEdgePlusX] && !cut[kEdgeMinusX] && !cut[kEdgeMinusY] && !cut[kEdgePlusY]);
}

}  // namespace
}  // namespace cabinet_articulation::core
