// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "cabinet_articulation/stereo/block_matcher.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

const StereoCamera kCamera = testCamera(32, 24);

std::string messageOf(const cv::Mat& depth) {
  try {
    frameFromDepth(depth, kCamera);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(FrameFromDepth, MetresAndMillimetresGiveTheSameDisparity) {
  const DepthFrame metres = frameFromDepth(cv::Mat1f(24, 32, 1.25F), kCamera);
  const DepthFrame millimetres = frameFromDepth(cv::Mat_<std::uint16_t>(24, 32, std::uint16_t{1250}), kCamera);
  EXPECT_NEAR(metres.disparity(5, 7), kCamera.disparity(1.25), 1e-4);
  EXPECT_NEAR(millimetres.disparity(5, 7), kCamera.disparity(1.25), 1e-4);
  EXPECT_TRUE(metres.left.empty());
  EXPECT_TRUE(metres.right.empty());
}

TEST(FrameFromDepth, WhatIsNoDepthIsInvalid) {
  cv::Mat1f depth(24, 32, 1.0F);
  const float kInfinity = std::numeric_limits<float>::infinity();
  const std::vector<float> bad = {0, -1, std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 1e-30F};
  for (size_t i = 0; i < bad.size(); ++i) depth(0, static_cast<int>(i)) = bad[i];
  const DepthFrame frame = frameFromDepth(depth, kCamera);
  for (size_t i = 0; i < bad.size(); ++i) EXPECT_EQ(frame.disparity(0, static_cast<int>(i)), 0) << bad[i];
  EXPECT_GT(frame.disparity(0, static_cast<int>(bad.size())), 0);
  EXPECT_EQ(frameFromDepth(cv::Mat_<std::uint16_t>(24, 32, std::uint16_t{0}), kCamera).disparity(3, 3), 0);
}

TEST(FrameFromDepth, OtherTypesAndSizesAreNamed) {
  EXPECT_NE(messageOf(cv::Mat1b(24, 32)).find("8 bit"), std::string::npos);
  EXPECT_NE(messageOf(cv::Mat3f(24, 32)).find("3 channels"), std::string::npos);
  EXPECT_NE(messageOf(cv::Mat()).find("empty"), std::string::npos);
  const std::string size = messageOf(cv::Mat1f(20, 30));
  EXPECT_NE(size.find("30x20"), std::string::npos) << size;
  EXPECT_NE(size.find("32x24"), std::string::npos) << size;
}

}  // namespace
}  // namespace cabinet_articulation::core
