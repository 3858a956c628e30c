// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_consensus.h"

#include <gtest/gtest.h>

#include <limits>

#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

/// A wall, a large door and a small drawer front that stands out by 10 cm at about 1.5 m.
const std::vector<Patch> kScene = {{{0.002, 0.003, 33}, {-100, -100, 900, 700}},
                                   {{0.05, 0.001, 30}, {100, 50, 200, 300}},
                                   {{0.001, -0.02, 50}, {400, 200, 120, 50}}};

DepthFrame noisyFrame(double noise) {
  DepthFrame frame;
  frame.camera = testCamera();
  frame.disparity = SyntheticPair({640, 480}, kScene).disparity;
  cv::RNG rng(5);
  for (float& d : frame.disparity) d += static_cast<float>(rng.gaussian(noise));
  return frame;
}

/// Largest distance [px] between the planes at the corners of an area.
double distance(const DisparityPlane& a, const DisparityPlane& b, const cv::Rect2d& area) {
  double largest = 0;
  for (const double u : {area.x, area.x + area.width})
    for (const double v : {area.y, area.y + area.height}) largest = std::max(largest, std::abs(a.at(u, v) - b.at(u, v)));
  return largest;
}

double nearest(const std::vector<DisparityPlane>& planes, const Patch& patch) {
  double best = 1e9;
  for (const DisparityPlane& plane : planes) best = std::min(best, distance(plane, patch.plane, patch.area));
  return best;
}

TEST(PlaneConsensus, FindsLargeAndSmallPlanesInNoise) {
  const auto planes = PlaneConsensus(PlanesConfig()).process(noisyFrame(0.15));
  ASSERT_GE(planes.size(), 3U);
  // 375 strided pixels of the smallest patch with 0.15 px of noise: 0.03 px at its corners; the rest is for the refit's
  // choice of inliers.
  for (const Patch& patch : kScene) EXPECT_LT(nearest(planes, patch), 0.1);
}

TEST(PlaneConsensus, IsDeterministicAndForgetsEarlierFrames) {
  const DepthFrame frame = noisyFrame(0.15), other = noisyFrame(0.4);
  PlaneConsensus consensus{PlanesConfig()};
  const auto first = consensus.process(frame);
  consensus.process(other);
  const auto again = consensus.process(frame);
  ASSERT_EQ(first.size(), again.size());
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].a, again[i].a);
    EXPECT_EQ(first[i].b, again[i].b);
    EXPECT_EQ(first[i].c, again[i].c);
  }
}

TEST(PlaneConsensus, BadDisparitiesAreIgnored) {
  DepthFrame frame = noisyFrame(0.15);
  const float kBad[] = {0, -5, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()};
  cv::RNG rng(9);
  for (float& d : frame.disparity)
    if (rng.uniform(0, 3) == 0) d = kBad[rng.uniform(0, 4)];
  const auto planes = PlaneConsensus(PlanesConfig()).process(frame);
  for (const Patch& patch : kScene) EXPECT_LT(nearest(planes, patch), 0.1);
}

TEST(PlaneConsensus, WithoutDepthThereAreNoPlanes) {
  DepthFrame frame;
  frame.camera = testCamera();
  EXPECT_TRUE(PlaneConsensus(PlanesConfig()).process(frame).empty());
  frame.disparity = cv::Mat1f(480, 640, 0.0F);
  EXPECT_TRUE(PlaneConsensus(PlanesConfig()).process(frame).empty());
  frame.disparity = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(PlaneConsensus(PlanesConfig()).process(frame).empty());
}

TEST(PlaneConsensus, StopsAtTheGivenNumberOfPlanes) {
  PlanesConfig config;
  config.max_planes = 2;
  EXPECT_EQ(PlaneConsensus(config).process(noisyFrame(0.15)).size(), 2U);
  config.max_planes = 0;
  EXPECT_THROW(PlaneConsensus{config}, ConfigError);
}

TEST(PlaneConsensus, PixelsOnOneLineAreNoReasonToFail) {
  DepthFrame frame;
  frame.camera = testCamera();
  frame.disparity = cv::Mat1f(480, 640, 0.0F);
  frame.disparity.row(100) = 40;
  const auto planes = PlaneConsensus(PlanesConfig()).process(frame);
  for (const DisparityPlane& plane : planes) EXPECT_NEAR(plane.at(300, 100), 40, 1);
}

}  // namespace
}  // namespace cabinet_articulation::core
