// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/stereo/block_matcher.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

const cv::Size kSize(320, 200);
const StereoCamera kCamera = testCamera(kSize.width, kSize.height);
const DisparityPlane kSlanted{0.03, -0.04, 42};

SyntheticPair wholeImage(const DisparityPlane& plane, double cx_difference = 0) {
  return SyntheticPair(kSize, {{plane, cv::Rect2d(-1000, -1000, 3000, 3000)}}, 2, cx_difference);
}

StereoConfig smallConfig() {
  StereoConfig config;
  config.disparity_range = 64;
  return config;
}

struct Error {
  double valid_share, median, wrong_share;  ///< wrong: by more than 1 px
};

Error errorIn(const cv::Rect& area, const cv::Mat1f& disparity, const cv::Mat1f& truth) {
  std::vector<float> errors;
  for (int v = area.y; v < area.y + area.height; ++v)
    for (int u = area.x; u < area.x + area.width; ++u)
      if (isValidDisparity(disparity(v, u))) errors.push_back(std::abs(disparity(v, u) - truth(v, u)));
  if (errors.empty()) return {0, 1e9, 1};
  std::sort(errors.begin(), errors.end());
  const double wrong = std::count_if(errors.begin(), errors.end(), [](float e) { return e > 1; });
  return {errors.size() / static_cast<double>(area.area()), errors[errors.size() / 2], wrong / errors.size()};
}

std::string messageOf(const cv::Mat& left, const cv::Mat& right) {
  try {
    BlockMatcher(smallConfig()).process(left, right, kCamera);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string configMessage(const StereoConfig& config) {
  try {
    BlockMatcher matcher(config);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(BlockMatcher, FindsTheDisparityOfASlantedPlane) {
  const SyntheticPair pair = wholeImage(kSlanted);
  const DepthFrame frame = BlockMatcher(smallConfig()).process(pair.left, pair.right, kCamera);
  // Block matching with 1/16 px steps is good for 0.1 - 0.15 px on projected texture.
  const Error error = errorIn({80, 20, 230, 160}, frame.disparity, pair.disparity);
  EXPECT_GT(error.valid_share, 0.97);
  EXPECT_LT(error.median, 0.15);
  EXPECT_LT(error.wrong_share, 0.005);
}

TEST(BlockMatcher, RecoversWhatTheRightImageShowsOfTheLeftBand) {
  const SyntheticPair pair = wholeImage(kSlanted);
  StereoConfig config = smallConfig();
  const DepthFrame with = BlockMatcher(config).process(pair.left, pair.right, kCamera);
  config.recover_left_band = false;
  const DepthFrame without = BlockMatcher(config).process(pair.left, pair.right, kCamera);
  const cv::Rect band(52, 20, 12, 160);  // left of disparity_range, but the plane's disparity is at most 44 there
  EXPECT_EQ(errorIn(band, without.disparity, pair.disparity).valid_share, 0);
  const Error error = errorIn(band, with.disparity, pair.disparity);
  EXPECT_GT(error.valid_share, 0.9);
  EXPECT_LT(error.median, 0.15);
  // What lies outside the right image cannot be matched: no disparity may be invented.
  for (int v = 0; v < kSize.height; ++v)
    for (int u = 0; u < 80; ++u) EXPECT_LE(with.disparity(v, u), std::max(0, u - config.correlation_window_size / 2));
}

TEST(BlockMatcher, DisparityIsFreeOfTheDifferenceOfPrincipalPoints) {
  StereoCamera camera = kCamera;
  camera.cx_difference = -6;
  const SyntheticPair pair = wholeImage(kSlanted, camera.cx_difference);
  const DepthFrame frame = BlockMatcher(smallConfig()).process(pair.left, pair.right, camera);
  EXPECT_LT(errorIn({80, 20, 230, 160}, frame.disparity, pair.disparity).median, 0.15);
}

TEST(BlockMatcher, TheSameImagesGiveTheSameBytesWhateverCameBefore) {
  const SyntheticPair first = wholeImage(kSlanted), second = wholeImage({0, 0.02, 30});
  BlockMatcher matcher(smallConfig());
  const DepthFrame alone = matcher.process(first.left, first.right, kCamera);
  const cv::Mat1f copy = alone.disparity.clone();
  const DepthFrame other = matcher.process(second.left, second.right, kCamera);
  cv::setNumThreads(1);
  const DepthFrame again = matcher.process(first.left, first.right, kCamera);
  EXPECT_EQ(cv::norm(copy, again.disparity, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(copy, alone.disparity, cv::NORM_INF), 0) << "a result changed after it was returned";
  EXPECT_NE(cv::norm(copy, other.disparity, cv::NORM_INF), 0);
  EXPECT_EQ(again.left.data, first.left.data) << "images are shared, not copied";
}

TEST(BlockMatcher, UntexturedImagesHaveNoDisparity) {
  const cv::Mat1b grey(kSize, std::uint8_t{90});
  EXPECT_EQ(cv::countNonZero(BlockMatcher(smallConfig()).process(grey, grey, kCamera).disparity), 0);
}

TEST(BlockMatcher, ImagesThatDoNotFitAreNamed) {
  const cv::Mat1b image(kSize, std::uint8_t{0});
  const std::string sizes = messageOf(image, cv::Mat1b(100, 160));
  EXPECT_NE(sizes.find("320x200"), std::string::npos) << sizes;
  EXPECT_NE(sizes.find("160x100"), std::string::npos) << sizes;
  EXPECT_NE(messageOf(image, cv::Mat3b(kSize)).find("3 channels"), std::string::npos);
  EXPECT_NE(messageOf(cv::Mat_<std::uint16_t>(kSize), image).find("16 bit"), std::string::npos);
  EXPECT_NE(messageOf(cv::Mat(), cv::Mat()).find("empty"), std::string::npos);
  const cv::Mat1b half(100, 160);
  EXPECT_NE(messageOf(half, half).find("calibration is for 320x200"), std::string::npos);
}

TEST(BlockMatcher, RefusesConfigurationsThatStereoBMCannotHave) {
  StereoConfig config;
  config.disparity_range = 100;
  EXPECT_NE(configMessage(config).find("multiple of 16"), std::string::npos);
  config = {};
  config.correlation_window_size = 14;
  EXPECT_NE(configMessage(config).find("correlation_window_size"), std::string::npos);
  config = {};
  config.prefilter_size = 8;
  EXPECT_NE(configMessage(config).find("prefilter_size"), std::string::npos);
  config = {};
  config.prefilter_cap = 64;
  EXPECT_NE(configMessage(config).find("prefilter_cap"), std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation::core
