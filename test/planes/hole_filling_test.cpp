// SPDX-License-Identifier: BSD-3-Clause
#include "planes/hole_filling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace cabinet_articulation::core {
namespace {

cv::Mat1f ramp(int rows, int cols) {
  cv::Mat1f disparity(rows, cols);
  for (int v = 0; v < rows; ++v)
    for (int u = 0; u < cols; ++u) disparity(v, u) = 40 + 0.25F * u - 0.125F * v;
  return disparity;
}

cv::Mat1f filled(const cv::Mat1f& disparity) {
  cv::Mat1f result;
  fillHoles(disparity, &result);
  return result;
}

TEST(FillHoles, SmallHolesLieInThePlaneOfTheirSurroundings) {
  const cv::Mat1f whole = ramp(40, 60);
  const std::vector<cv::Rect> holes = {{7, 5, 1, 1}, {20, 10, 3, 3}, {30, 20, 30, 1}, {40, 25, 1, 15}, {10, 30, 2, 2}};
  for (const float nothing : {0.F, -1.F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    cv::Mat1f disparity = whole.clone();
    for (const cv::Rect& hole : holes) disparity(hole & cv::Rect(3, 3, 54, 34)) = nothing;
    // Thirds are rounded; a float of 40 has steps of 4e-6.
    EXPECT_LT(cv::norm(filled(disparity), whole, cv::NORM_INF), 1e-5);
  }
}

TEST(FillHoles, GapsBetweenSurfacesStay) {
  cv::Mat1f disparity(10, 20, 40.F);
  disparity.colRange(0, 10) = 50;
  disparity.col(10) = 0;
  EXPECT_EQ(cv::norm(filled(disparity), disparity, cv::NORM_INF), 0);
}

TEST(FillHoles, WideHolesAndTheBorderStay) {
  cv::Mat1f disparity(20, 20, 40.F);
  disparity(cv::Rect(5, 5, 6, 6)) = 0;
  disparity(0, 10) = 0;
  disparity(10, 19) = 0;
  EXPECT_EQ(cv::norm(filled(disparity), disparity, cv::NORM_INF), 0);
}

TEST(FillHoles, TheMeasuredPixelsAndTheInputStay) {
  const cv::Mat1f disparity = ramp(20, 30);
  const cv::Mat1f view = disparity(cv::Rect(3, 2, 20, 15));
  EXPECT_EQ(cv::norm(filled(view), view, cv::NORM_INF), 0);
  EXPECT_TRUE(filled(cv::Mat1f()).empty());
  EXPECT_EQ(filled(cv::Mat1f(1, 1, 0.F)).total(), 1U);
}

}  // namespace
}  // namespace cabinet_articulation::core
