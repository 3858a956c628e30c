// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <vector>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "pipeline/same_bits.h"

namespace cabinet_articulation::core {
namespace {

TEST(Pipeline, TheNumberOfThreadsChangesNoBit) {
  SimulationConfig config;
  config.scene = "kitchen";
  config.rate = 5;
  SimulatedStereoCamera simulation(config);
  std::vector<StereoFrame> frames;
  for (int i = 8; i < 14; ++i) frames.push_back(simulation.frame(i));
  const auto run = [&](int threads) {
    cv::setNumThreads(threads);
    Pipeline pipeline({});
    std::vector<PipelineResult> results;
    for (size_t i = 0; i < frames.size(); ++i)
      results.push_back(pipeline.process(i / config.rate, frames[i].left, frames[i].right, simulation.camera()));
    return results;
  };
  const int before = cv::getNumThreads();
  const std::vector<PipelineResult> expected = run(1);
  ASSERT_FALSE(expected.back().rectangles.empty());
  for (const int threads : {2, 4}) {
    const std::vector<PipelineResult> results = run(threads);
    for (size_t i = 0; i < frames.size(); ++i) {
      EXPECT_EQ(cv::norm(results[i].frame.disparity, expected[i].frame.disparity, cv::NORM_INF), 0);
      expectSameBits(results[i], expected[i]);
    }
  }
  cv::setNumThreads(before);
}

}  // namespace
}  // namespace cabinet_articulation::core
