// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/image_sensor.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kBlackLevel = 3;

SimulationConfig plainConfig() {
  SimulationConfig config;
  config.vignetting = 0;
  return config;
}

cv::Mat1f flat(double radiance) { return cv::Mat1f(480, 640, static_cast<float>(radiance)); }

double deviation(const cv::Mat& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return deviation[0];
}

TEST(ImageSensor, NoiseIsShotAndReadNoise) {
  const SimulationConfig config = plainConfig();
  ImageSensor sensor(config);
  for (const double radiance : {0.1, 0.4, 1.0}) {
    for (const double gain : {1.0, 2.0}) {
      const cv::Mat1b image = sensor.expose(flat(radiance), gain, 7);
      const double electrons = 0.35 * radiance * config.full_well;
      const double grey_per_electron = gain * 255 / config.full_well;
      EXPECT_NEAR(cv::mean(image)[0], kBlackLevel + electrons * grey_per_electron, 0.05);
      // 1/12: rounding to whole grey values. 300,000 pixels know the deviation to 0.15 %.
      const double sigma = std::sqrt((electrons + std::pow(config.read_noise, 2)) * std::pow(grey_per_electron, 2) + 1.0 / 12);
      EXPECT_NEAR(deviation(image), sigma, 0.02 * sigma) << radiance << ' ' << gain;
    }
  }
}

TEST(ImageSensor, NoiseOfDifferentStreamsIsIndependentAndOfOneStreamTheSame) {
  ImageSensor sensor(plainConfig());
  const cv::Mat1b a = sensor.expose(flat(0.5), 1, 1), b = sensor.expose(flat(0.5), 1, 2);
  const cv::Mat1b again = sensor.expose(flat(0.5), 1, 1);
  EXPECT_EQ(cv::norm(a, again, cv::NORM_INF), 0);
  cv::Mat difference;
  cv::subtract(a, b, difference, cv::noArray(), CV_32F);
  // Independent noise of equal size: the difference is sqrt(2) as noisy.
  EXPECT_NEAR(deviation(difference), std::sqrt(2) * deviation(a), 0.02 * deviation(a));
}

TEST(ImageSensor, RowsHaveTheirOwnNoise) {
  ImageSensor sensor(plainConfig());
  const cv::Mat1b image = sensor.expose(flat(0.5), 1, 1);
  cv::Mat difference;
  cv::subtract(image.rowRange(0, 479), image.rowRange(1, 480), difference, cv::noArray(), CV_32F);
  EXPECT_NEAR(deviation(difference), std::sqrt(2) * deviation(image), 0.02 * deviation(image));
}

TEST(ImageSensor, AutomaticGainAimsAtTheTargetWithinItsLimits) {
  const SimulationConfig config = plainConfig();
  ImageSensor sensor(config);
  const double gain = sensor.automaticGain(flat(0.1));
  EXPECT_NEAR(cv::mean(sensor.expose(flat(0.1), gain, 1))[0], config.target_brightness, 0.1);
  EXPECT_EQ(sensor.automaticGain(flat(5)), 1);
  EXPECT_EQ(sensor.automaticGain(flat(1e-4)), config.max_gain);
  EXPECT_EQ(sensor.automaticGain(flat(0)), config.max_gain);
}

TEST(ImageSensor, SaturatesWithoutWrappingRound) {
  ImageSensor sensor(plainConfig());
  EXPECT_GT(cv::mean(sensor.expose(flat(50), 8, 1))[0], 254.9);
  double least = 0;
  cv::minMaxLoc(sensor.expose(flat(50), 8, 1), &least);
  EXPECT_GT(least, 250);
}

TEST(ImageSensor, VignettingDarkensTheCorners) {
  SimulationConfig config;
  config.vignetting = 0.4;
  ImageSensor sensor(config);
  const cv::Mat1b image = sensor.expose(flat(2), 1, 1);
  const double centre = cv::mean(image(cv::Rect(310, 230, 20, 20)))[0] - kBlackLevel;
  const double corner = cv::mean(image(cv::Rect(0, 0, 20, 20)))[0] - kBlackLevel;
  EXPECT_NEAR(corner / centre, 0.6, 0.03);
}

TEST(ImageSensor, LensBlurSpreadsAnEdge) {
  SimulationConfig config = plainConfig();
  config.read_noise = 0;
  config.full_well = 1e6;
  config.lens_blur = 1;
  ImageSensor sensor(config);
  cv::Mat1f edge = flat(0);
  edge.colRange(320, 640).setTo(1);
  const cv::Mat1b image = sensor.expose(edge, 1, 1);
  // Gaussian of sigma 1: the first bright pixel's centre is 0.5 sigma inside, so it gets 69 % of 89.25.
  EXPECT_NEAR(image(240, 320), kBlackLevel + 0.69 * 89.25, 3);
  EXPECT_NEAR(image(240, 319), kBlackLevel + 0.31 * 89.25, 3);
}

}  // namespace
}  // namespace cabinet_articulation::core
