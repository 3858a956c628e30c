// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/stereo/depth_view.h"

#include <gtest/gtest.h>

#include "cabinet_articulation/stereo/block_matcher.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

TEST(DepthView, IsTheSameSurfaceOnACoarseGrid) {
  // A slanted plane, disparity = 40 + 0.02 u - 0.01 v.
  const StereoCamera camera = testCamera(640, 480);
  DepthFrame frame;
  frame.camera = camera;
  frame.disparity.create(480, 640);
  for (int v = 0; v < 480; ++v)
    for (int u = 0; u < 640; ++u) frame.disparity(v, u) = 40 + 0.02F * static_cast<float>(u) - 0.01F * static_cast<float>(v);
  const DepthView view = thinnedOut(frame);
  ASSERT_EQ(view.columns, 80);
  ASSERT_EQ(view.rows, 60);
  ASSERT_EQ(view.depth.size(), 4800u);
  for (const cv::Point cell : {cv::Point(0, 0), cv::Point(79, 59), cv::Point(30, 12)}) {
    const Eigen::Vector3d point = view.at(cell.x, cell.y) * view.ray(cell.x, cell.y);
    const Eigen::Vector2d pixel = camera.project(point);
    EXPECT_NEAR(pixel.x(), 8 * cell.x + 3.5, 1e-3) << "the middle of the cell";
    EXPECT_NEAR(camera.disparity(point.z()), 40 + 0.02 * pixel.x() - 0.01 * pixel.y(), 1e-3);
  }
}

TEST(DepthView, HasTheSurfaceInTheMiddleOfACellAndNothingWhereNothingWasMeasured) {
  DepthFrame frame;
  frame.camera = testCamera(160, 120);
  frame.disparity = cv::Mat1f(120, 160, 20.0F);
  frame.disparity(cv::Rect(0, 0, 80, 120)) = 0;
  frame.disparity(cv::Rect(80, 0, 1, 120)) = 60;  // a border, half a cell wide
  const DepthView view = thinnedOut(frame);
  ASSERT_EQ(view.columns, 80);
  EXPECT_EQ(view.at(10, 10), 0);
  EXPECT_NEAR(view.at(60, 10), frame.camera.depth(20), 1e-4);
  EXPECT_TRUE(thinnedOut(DepthFrame()).empty());
  frame.disparity = cv::Mat1f(10, 1280, 20.0F);
  EXPECT_EQ(thinnedOut(frame).columns, 0) << "too flat for a row of cells";
}

}  // namespace
}  // namespace cabinet_articulation::core
