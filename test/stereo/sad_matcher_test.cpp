// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/sad_matcher.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

struct Pair {
  cv::Mat1b left, right;
};

/// The kitchen as the simulated camera sees it, `width` columns and 200 rows of it.
Pair kitchen(int width = 480) {
  static const StereoFrame frame = [] {
    SimulationConfig config;
    config.scene = "kitchen";
    return SimulatedStereoCamera(config).frame(60);
  }();
  const cv::Rect part(80, 150, width, 200);
  return {frame.left(part), frame.right(part)};
}

/// Four grey values at random: many sums are equal, and some are as large as they can be.
Pair noise() {
  Pair pair{cv::Mat1b(120, 300), cv::Mat1b(120, 300)};
  cv::RNG random(5);
  for (cv::Mat1b* image : {&pair.left, &pair.right})
    for (std::uint8_t& pixel : *image) pixel = static_cast<std::uint8_t>(random(4) * 85);
  return pair;
}

cv::Mat1s ofStereoBm(const Pair& pair, const StereoConfig& config) {
  const auto matcher = cv::StereoBM::create(config.disparity_range, config.correlation_window_size);
  matcher->setMinDisparity(config.min_disparity);
  matcher->setPreFilterType(cv::StereoBM::PREFILTER_XSOBEL);
  matcher->setPreFilterCap(config.prefilter_cap);
  matcher->setTextureThreshold(config.texture_threshold);
  matcher->setUniquenessRatio(static_cast<int>(config.uniqueness_ratio));
  matcher->setSpeckleWindowSize(config.speckle_size);
  matcher->setSpeckleRange(config.speckle_range);
  const int pad = config.recover_left_band ? config.disparity_range + std::max(config.min_disparity, 0) : 0;
  cv::Mat left, right;
  cv::Mat1s result;
  cv::copyMakeBorder(pair.left, left, 0, 0, pad, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  cv::copyMakeBorder(pair.right, right, 0, 0, pad, 0, cv::BORDER_REPLICATE | cv::BORDER_ISOLATED);
  matcher->compute(left, right, result);
  return result.colRange(pad, result.cols);
}

int countMatches(const cv::Mat1s& sixteenths, const StereoConfig& config) {
  return cv::countNonZero(sixteenths >= config.min_disparity * cv::StereoMatcher::DISP_SCALE);
}

/// Where both match whole windows in the same images. StereoBM has no gradient in an odd image's last row. Below disparity 0 it
/// matches blocks beyond the right image's border.
cv::Rect comparable(cv::Size size, const StereoConfig& config) {
  const int radius = config.correlation_window_size / 2;
  return {0, 0, size.width + std::min(config.min_disparity - radius, 0), size.height - (size.height % 2) * (radius + 1)};
}

void expectStereoBms(const Pair& pair, const StereoConfig& config, const std::string& name, int least_matches = 1000) {
  ASSERT_TRUE(SadMatcher::supports(config)) << name;
  const cv::Rect area = comparable(pair.left.size(), config);
  const cv::Mat1s expected = ofStereoBm(pair, config)(area);
  const cv::Mat1s found = SadMatcher(config).compute(pair.left, pair.right)(area);
  EXPECT_GE(countMatches(expected, config), least_matches) << name;
  const cv::Mat1b different = expected != found;
  EXPECT_EQ(cv::countNonZero(different), 0) << name << ", within " << cv::boundingRect(different);
}

StereoConfig with(int StereoConfig::*setting, int value) {
  StereoConfig config;
  config.*setting = value;
  return config;
}

TEST(SadMatcher, FindsStereoBmsDisparitiesBitForBit) { expectStereoBms(kitchen(), {}, "default"); }

TEST(SadMatcher, AgreesWithStereoBmForEveryNumberOfDisparities) {
  for (const int disparities : {16, 32, 48, 64, 80, 112, 144, 256, 400})
    for (const bool recover : {true, false}) {
      StereoConfig config = with(&StereoConfig::disparity_range, disparities);
      config.recover_left_band = recover;
      expectStereoBms(kitchen(), config, std::to_string(disparities) + " disparities", 0);
    }
}

TEST(SadMatcher, AgreesWithStereoBmForEveryLeastDisparity) {
  for (const int least : {-200, -64, -10, 7, 30})
    for (const bool recover : {true, false}) {
      StereoConfig config = with(&StereoConfig::min_disparity, least);
      config.recover_left_band = recover;
      // A patch may reach into what is not compared.
      if (least < 0) config.speckle_size = 0;
      expectStereoBms(kitchen(), config, std::to_string(least) + " px", 0);
    }
}

TEST(SadMatcher, AgreesWithStereoBmForEverySetting) {
  for (const int size : {5, 7, 11, 19, 21})
    expectStereoBms(kitchen(), with(&StereoConfig::correlation_window_size, size), std::to_string(size) + " px windows");
  for (const int cap : {1, 5, 30})
    expectStereoBms(kitchen(), with(&StereoConfig::prefilter_cap, cap), "cap " + std::to_string(cap), 100);
  for (const int threshold : {0, 500, 2500})
    expectStereoBms(kitchen(), with(&StereoConfig::texture_threshold, threshold), "texture " + std::to_string(threshold));
  for (const int size : {0, 1000})
    expectStereoBms(kitchen(), with(&StereoConfig::speckle_size, size), "speckles " + std::to_string(size));
  for (const double ratio : {0, 1, 5, 40}) {
    StereoConfig config;
    config.uniqueness_ratio = ratio;
    expectStereoBms(kitchen(), config, "ambiguity " + std::to_string(ratio));
  }
  StereoConfig config = with(&StereoConfig::correlation_window_size, 9);
  config.prefilter_cap = 63;
  expectStereoBms(kitchen(), config, "cap 63");
}

TEST(SadMatcher, AgreesWithStereoBmWhereManySumsAreEqual) {
  StereoConfig config;
  config.speckle_size = 0;
  config.texture_threshold = 0;
  for (const double ratio : {0, 15})
    for (const int size : {5, 21}) {
      config.uniqueness_ratio = ratio;
      config.correlation_window_size = size;
      expectStereoBms(noise(), config, "noise", 0);
      const cv::Mat1b flat(120, 300, std::uint8_t{90});
      expectStereoBms({flat, flat}, config, "flat", 0);
      // A pattern that repeats itself: only the ambiguity test refuses it.
      cv::Mat1b stripes(120, 300);
      for (int u = 0; u < stripes.cols; ++u) stripes.col(u) = u % 12 < 6 ? 40 : 120;
      expectStereoBms({stripes, stripes}, config, "stripes", ratio > 0 ? 0 : 1000);
    }
}

TEST(SadMatcher, AgreesWithStereoBmForAnyImageSize) {
  const Pair pair = kitchen();
  StereoConfig config = with(&StereoConfig::disparity_range, 64);
  for (const int width : {16, 17, 40, 129, 203, 333, 480})
    for (const int height : {16, 17, 18, 51, 120}) {
      config.speckle_size = height % 2 == 0 ? 100 : 0;  // a patch may reach into what is not compared
      const cv::Rect part(0, 30, width, height);
      const std::string name = std::to_string(width) + "x" + std::to_string(height);
      expectStereoBms({pair.left(part), pair.right(part)}, config, name, width > 100 && height > 50 ? 1000 : 0);
    }
}

TEST(SadMatcher, NeitherThreadsNorVectorsNorFramesBeforeChangeABit) {
  const int threads_before = cv::getNumThreads();
  const Pair pair = kitchen();
  cv::setNumThreads(1);
  SadMatcher matcher({});
  const cv::Mat1s expected = matcher.compute(pair.left, pair.right).clone();
  for (const bool all_vectors : {true, false})
    for (const int threads : {1, 2, 3, 8}) {
      cv::setUseOptimized(all_vectors);
      cv::setNumThreads(threads);
      SadMatcher another({});
      EXPECT_EQ(cv::norm(another.compute(pair.left, pair.right), expected, cv::NORM_INF), 0) << threads << all_vectors;
      matcher.compute(pair.right, pair.left);
      EXPECT_EQ(cv::norm(matcher.compute(pair.left, pair.right), expected, cv::NORM_INF), 0) << threads << all_vectors;
    }
  cv::setUseOptimized(true);
  cv::setNumThreads(threads_before);
}

TEST(SadMatcher, LargerSumsThanSixteenBitsAreLeftToStereoBm) {
  StereoConfig config = with(&StereoConfig::correlation_window_size, 23);
  EXPECT_FALSE(SadMatcher::supports(config));
  const Pair pair = kitchen();
  const StereoCamera camera = testCamera(pair.left.cols, pair.left.rows);
  const cv::Mat1f disparities = BlockMatcher(config).process(pair.left, pair.right, camera).disparity;
  EXPECT_GT(cv::countNonZero(disparities > 0), pair.left.total() / 3);
  config.matcher = "opencv";
  EXPECT_EQ(cv::norm(BlockMatcher(config).process(pair.left, pair.right, camera).disparity, disparities, cv::NORM_INF), 0);
}

TEST(SadMatcher, TheSettingSelectsAmongEqualFrames) {
  const Pair pair = kitchen();
  StereoCamera camera = testCamera(pair.left.cols, pair.left.rows);
  camera.cx_difference = -3;
  StereoConfig config;
  const cv::Mat1f own = BlockMatcher(config).process(pair.left, pair.right, camera).disparity;
  config.matcher = "opencv";
  EXPECT_EQ(cv::norm(BlockMatcher(config).process(pair.left, pair.right, camera).disparity, own, cv::NORM_INF), 0);
  config.matcher = "other";
  EXPECT_THROW(BlockMatcher{config}, ConfigError);
}

}  // namespace
}  // namespace cabinet_articulation::core
