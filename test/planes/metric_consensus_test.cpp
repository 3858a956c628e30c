// SPDX-License-Identifier: BSD-3-Clause
#include "planes/metric_consensus.h"

#include <gtest/gtest.h>

#include "geometry/degrees.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

const std::vector<Patch> kScene = {{{0.002, 0.003, 33}, {-100, -100, 900, 700}}, {{0.05, 0.001, 30}, {100, 50, 200, 300}}};

DepthFrame noisyFrame() {
  DepthFrame frame;
  frame.camera = testCamera();
  frame.disparity = SyntheticPair({640, 480}, kScene).disparity;
  cv::RNG rng(5);
  for (float& d : frame.disparity) d += static_cast<float>(rng.gaussian(0.1));
  return frame;
}

TEST(MetricConsensus, FindsLargePlanes) {
  const DepthFrame frame = noisyFrame();
  const auto planes = MetricConsensus(PlanesConfig()).process(frame);
  for (const Patch& patch : kScene) {
    const Plane truth = *toPlane(patch.plane, frame.camera);
    double best = 0, offset = 0;
    for (const Plane& plane : planes)
      if (plane.normal.dot(truth.normal) > best) {
        best = plane.normal.dot(truth.normal);
        offset = plane.offset;
      }
    // 0.1 px is 6 mm at 1.9 m; thousands of points average it away, but the rim of d = 2 cm cuts into the neighbour.
    EXPECT_GT(best, std::cos(0.5 * kDegree));
    EXPECT_NEAR(offset, truth.offset, 0.01);
  }
}

TEST(MetricConsensus, IsDeterministicAndFollowsItsSeed) {
  const DepthFrame frame = noisyFrame();
  PlanesConfig config;
  const auto first = MetricConsensus(config).process(frame), again = MetricConsensus(config).process(frame);
  ASSERT_EQ(first.size(), again.size());
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].normal, again[i].normal);
    EXPECT_EQ(first[i].offset, again[i].offset);
  }
  config.seed = 2;
  EXPECT_NE(MetricConsensus(config).process(frame)[0].normal, first[0].normal);
}

TEST(MetricConsensus, WithoutDepthThereAreNoPlanes) {
  DepthFrame frame;
  frame.camera = testCamera();
  EXPECT_TRUE(MetricConsensus(PlanesConfig()).process(frame).empty());
  frame.disparity = cv::Mat1f(480, 640, 0.0F);
  EXPECT_TRUE(MetricConsensus(PlanesConfig()).process(frame).empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
