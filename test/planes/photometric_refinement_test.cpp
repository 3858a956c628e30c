// SPDX-License-Identifier: BSD-3-Clause
#include "planes/photometric_refinement.h"

#include <gtest/gtest.h>

#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

const cv::Size kSize(320, 240);
const cv::Rect kArea(120, 60, 120, 50);  ///< a drawer front at 1.5 m
const DisparityPlane kTruth{0.02, -0.03, 44};

/// Wrong as least squares on block matching are: by tenths of a pixel that change over the front.
const DisparityPlane kStart{0.022, -0.022, 43.2};

struct Scene {
  explicit Scene(double noise = 2, double cx_difference = 0)
      : pair(kSize, {{{0, 0, 30}, {-500, -500, 2000, 2000}}, {kTruth, kArea}}, noise, cx_difference) {
    frame.camera = testCamera(kSize.width, kSize.height);
    frame.camera.cx_difference = cx_difference;
    frame.disparity = pair.disparity;
    frame.left = pair.left;
    frame.right = pair.right;
    GrownRegion region;
    region.plane = kStart;
    for (int v = kArea.y; v < kArea.y + kArea.height; v += kCell)
      set.runs.push_back({v / kCell, kArea.x / kCell, (kArea.x + kArea.width) / kCell});
    region.last_run = static_cast<int>(set.runs.size());
    region.cells = kArea.area() / (kCell * kCell);
    set.regions.push_back(region);
  }

  DisparityPlane refined(const PlanesConfig& config = {}) {
    PhotometricRefinement(config).process(frame, cv::Mat1f(kSize, 1e6F), &set);
    return set.regions[0].plane;
  }

  SyntheticPair pair;
  DepthFrame frame;
  RegionSet set;
};

double largestError(const DisparityPlane& plane) {
  double error = 0;
  for (const int u : {kArea.x, kArea.x + kArea.width})
    for (const int v : {kArea.y, kArea.y + kArea.height}) error = std::max(error, std::abs(plane.at(u, v) - kTruth.at(u, v)));
  return error;
}

// 6000 pixels with a noise of about 2.7 grey levels in the difference and slopes of about 15 grey levels per pixel give
// 0.0023 px in the middle and three times that at a corner; 0.03 px leaves room for interpolation.
constexpr double kExpected = 0.03;

TEST(PhotometricRefinement, RecoversThePlaneFromTheImages) {
  ASSERT_GT(largestError(kStart), 0.4);
  EXPECT_LT(largestError(Scene().refined()), kExpected);
}

TEST(PhotometricRefinement, BearsNoiseAndAnOffsetOfThePrincipalPoints) {
  EXPECT_LT(largestError(Scene(8).refined()), 4 * kExpected);
  EXPECT_LT(largestError(Scene(2, -6).refined()), kExpected);
}

TEST(PhotometricRefinement, ToleratesRowsThatAreOff) {
  Scene scene;
  cv::Mat1b shifted(kSize);
  for (int v = 0; v < kSize.height; ++v)  // what was in row v appears at v + 0.4
    for (int u = 0; u < kSize.width; ++u)
      shifted(v, u) =
          cv::saturate_cast<std::uint8_t>(0.6 * scene.pair.right(v, u) + 0.4 * scene.pair.right(std::max(v - 1, 0), u));
  scene.frame.right = shifted;
  EXPECT_LT(largestError(scene.refined()), kExpected);
}

TEST(PhotometricRefinement, IgnoresWhatCoversTheSurface) {
  Scene scene;
  cv::Mat1b left = scene.pair.left.clone();
  left(cv::Rect(150, 60, 30, 50)) = 20;  // an arm over a quarter of the front
  scene.frame.left = left;
  EXPECT_LT(largestError(scene.refined()), 2 * kExpected);
}

TEST(PhotometricRefinement, PixelsOfOtherSurfacesAreNotUsed) {
  Scene scene;
  scene.set.regions[0].plane = kTruth;
  scene.frame.disparity = scene.pair.disparity.clone();
  scene.frame.disparity(kArea) += 1;
  PhotometricRefinement(PlanesConfig()).process(scene.frame, cv::Mat1f(kSize, 0.5F), &scene.set);
  EXPECT_EQ(largestError(scene.set.regions[0].plane), 0) << "no pixel left: the plane stays";
}

TEST(PhotometricRefinement, WithoutTextureThePlaneStays) {
  Scene scene;
  scene.frame.left = cv::Mat1b(kSize, std::uint8_t{90});
  scene.frame.right = cv::Mat1b(kSize, std::uint8_t{90});
  const DisparityPlane plane = scene.refined();
  EXPECT_EQ(plane.a, kStart.a);
  EXPECT_EQ(plane.c, kStart.c);
}

TEST(PhotometricRefinement, NoiseIsNoTexture) {
  Scene scene;
  cv::RNG random(1);
  for (cv::Mat1b* image : {&scene.frame.left, &scene.frame.right}) {
    *image = cv::Mat1b(kSize);
    random.fill(*image, cv::RNG::NORMAL, 90, 1);
  }
  EXPECT_EQ(scene.refined().c, kStart.c);
}

TEST(PhotometricRefinement, AResultThatMovesTooFarIsRejected) {
  PlanesConfig config;
  config.refine_max_shift = 0.3;
  Scene scene;
  EXPECT_EQ(scene.refined(config).c, kStart.c);
}

TEST(PhotometricRefinement, APlaneThatLeavesTheRightImageStays) {
  Scene scene;
  scene.set.regions[0].plane.c = kStart.c + 500;
  EXPECT_EQ(scene.refined().c, kStart.c + 500);
}

}  // namespace
}  // namespace cabinet_articulation::core
