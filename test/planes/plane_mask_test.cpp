// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

const StereoCamera kCamera = testCamera(64, 4);
const DisparityTolerance kTolerance(kCamera, 0.8, 0.008, 2);

cv::Mat1b maskOf(const cv::Mat1f& disparity, const DisparityPlane& plane, const cv::Mat1f& limits) {
  NoiseMask labels;
  labels.setFrame(disparity, kTolerance, limits);
  cv::Mat1b mask;
  labels.label(plane, &mask);
  return mask;
}

int labelOf(float disparity, const DisparityPlane& plane, float limit = 1e6F) {
  const cv::Mat1b mask = maskOf(cv::Mat1f(4, 64, disparity), plane, cv::Mat1f(4, 64, limit));
  EXPECT_EQ(cv::countNonZero(mask != mask(0, 0)), 0) << "the same in every column";
  return mask(0, 0);
}

TEST(DisparityTolerance, IsTheLargerOfPixelsAndMetresUpToTheCap) {
  const double fB = kCamera.focalBaseline();
  EXPECT_FLOAT_EQ(kTolerance.at(20), 0.8F);
  const float d = 85;  // 8 mm at 0.73 m are 0.93 px
  EXPECT_NEAR(kTolerance.at(d), fB / (fB / d - 0.008) - d, 0.02);
  EXPECT_FLOAT_EQ(kTolerance.at(300), 2.0F);
}

TEST(PlaneMask, LabelsFollowTheSignAndSizeOfTheResidual) {
  const DisparityPlane plane{0, 0, 40};
  EXPECT_EQ(labelOf(40, plane), kInPlane);
  EXPECT_EQ(labelOf(40.79F, plane), kInPlane);
  EXPECT_EQ(labelOf(39.21F, plane), kInPlane);
  EXPECT_EQ(labelOf(40.9F, plane), kOccluded) << "a larger disparity is nearer, so it hides the plane";
  EXPECT_EQ(labelOf(39.1F, plane), kFree);
}

TEST(PlaneMask, WhatWasNotMeasuredIsUnknown) {
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {0.0F, -40.0F, std::numeric_limits<float>::quiet_NaN(), infinity, -infinity})
    EXPECT_EQ(labelOf(bad, {0, 0, 40}), kUnknown) << bad;
}

TEST(PlaneMask, PixelsOfANearerRegionAreOtherPlane) {
  EXPECT_EQ(labelOf(40.5F, {0, 0, 40}, 0.6F), kInPlane);
  EXPECT_EQ(labelOf(40.5F, {0, 0, 40}, 0.4F), kOtherPlane);
  EXPECT_EQ(labelOf(42, {0, 0, 40}, 0.4F), kOccluded) << "only in-plane pixels can be another's";
}

TEST(PlaneMask, FollowsSlantedPlanesOverRowsAndColumns) {
  const DisparityPlane plane{0.1, -2, 40};
  cv::Mat1f disparity(4, 64);
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 64; ++u) disparity(v, u) = static_cast<float>(plane.at(u, v) + (u == v ? 1 : 0));
  const cv::Mat1b mask = maskOf(disparity, plane, cv::Mat1f(4, 64, 1e6F));
  EXPECT_EQ(cv::countNonZero(mask == kInPlane), 4 * 63);
  EXPECT_EQ(mask(3, 3), kOccluded);
}

/// Steps, slopes and holes of all sizes, so that planes lie before, behind and across blocks.
TEST(PlaneMask, BlocksSayWhatTheirPixelsSay) {
  cv::RNG random(1);
  cv::Mat1f disparity(75, 101), limits(75, 101);
  for (int v = 0; v < disparity.rows; ++v)
    for (int u = 0; u < disparity.cols; ++u) {
      const float surface = (u / 40 + v / 30) % 2 ? 30 + 0.1F * static_cast<float>(u) : 42.0F;
      disparity(v, u) = random.uniform(0, 5) == 0 ? -1 : surface + random.uniform(-1.0F, 1.0F);
      limits(v, u) = random.uniform(0.0F, 2.0F);
    }
  for (int i = 0; i < 200; ++i) {
    const DisparityPlane plane{random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(20.0, 50.0)};
    const cv::Mat1b mask = maskOf(disparity, plane, limits);
    for (int v = 0; v < mask.rows; ++v)
      for (int u = 0; u < mask.cols; ++u) {
        const float d = disparity(v, u);
        const float expected = static_cast<float>(plane.a) * static_cast<float>(u) + static_cast<float>(plane.at(0, v));
        int label = d > expected ? kOccluded : kFree;
        if (std::abs(d - expected) <= kTolerance.at(d)) label = std::abs(d - expected) > limits(v, u) ? kOtherPlane : kInPlane;
        ASSERT_EQ(mask(v, u), d > 0 ? label : kUnknown) << "plane " << i << " at " << u << ", " << v;
      }
  }
}

TEST(PlaneMask, DistancesAreMeasuredAlongTheNormal) {
  const Plane plane{Eigen::Vector3d(0.6, 0, -0.8), 1.2};
  DepthFrame frame;
  frame.camera = kCamera;
  frame.disparity.create(4, 64);
  const double distances[] = {-0.03, -0.019, 0.019, 0.03};  // positive: nearer to the camera
  for (int v = 0; v < 4; ++v)
    for (int u = 0; u < 64; ++u) {
      const Plane shifted{plane.normal, plane.offset - distances[v]};
      frame.disparity(v, u) = static_cast<float>(kCamera.disparity(shifted.intersect(kCamera.ray(u, v))->z()));
    }
  cv::Mat1b mask;
  labelByDistance(frame, plane, 0.02, &mask);
  const int expected[] = {kFree, kInPlane, kInPlane, kOccluded};
  for (int v = 0; v < 4; ++v) EXPECT_EQ(cv::countNonZero(mask.row(v) == expected[v]), 64) << v;
}

TEST(PlaneMask, APlaneThroughTheCameraShowsNothing) {
  DepthFrame frame;
  frame.camera = kCamera;
  frame.disparity = cv::Mat1f(4, 64, 30.0F);
  cv::Mat1b mask;
  labelByDistance(frame, {Eigen::Vector3d::UnitX(), 0}, 0.02, &mask);
  EXPECT_EQ(cv::countNonZero(mask != kUnknown), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
