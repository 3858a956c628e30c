// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <opencv2/core/utility.hpp>

#include "allocation_counter.h"
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "cabinet_articulation/rectangles/rectangle_detector.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "cabinet_articulation/tracking/rectangle_tracker.h"

namespace cabinet_articulation::core {
namespace {

/// The stages of the core on one frame, again and again, by one thread: more threads have small change of their own.
class SteadyFrameMemory : public testing::Test {
 protected:
  SteadyFrameMemory() { cv::setNumThreads(1); }
  ~SteadyFrameMemory() override { cv::setNumThreads(threads_); }

  void process() {
    const DepthFrame frame = stereo_.process(images_.left, images_.right, simulation_.camera());
    const std::vector<PlaneRegion> regions = planes_.process(frame);
    const std::vector<DetectedRectangle> found = rectangles_.process(frame, regions, expected_);
    tracker_.process(stamp_ += 1.0 / 15, found);
    expected_.clear();
    for (const DetectedRectangle& detection : found) expected_.push_back(detection.rectangle);
    regions_ = regions.size();
  }

  static SimulationConfig kitchen() {
    SimulationConfig config;
    config.scene = "kitchen";
    config.rate = 5;
    return config;
  }

  const int threads_ = cv::getNumThreads();
  SimulatedStereoCamera simulation_{kitchen()};
  const StereoFrame images_ = simulation_.frame(10);
  BlockMatcher stereo_{StereoConfig()};
  PlaneSegmenter planes_{PlanesConfig()};
  RectangleDetector rectangles_{RectanglesConfig(), PlanesConfig()};
  RectangleTracker tracker_{TrackingConfig()};
  std::vector<Rectangle> expected_;
  double stamp_ = 0;
  size_t regions_ = 0;
};

TEST_F(SteadyFrameMemory, AFrameTakesFewBlocksAndNoLargeOne) {
  for (int i = 0; i < 5; ++i) process();
  const evaluation::Allocations before = evaluation::allocations();
  process();
  const evaluation::Allocations after = evaluation::allocations();
  EXPECT_GT(regions_, 10U);
  EXPECT_FALSE(expected_.empty());
  EXPECT_LE(after.count - before.count, 200);
  EXPECT_LE(after.largest, 4096) << "[bytes]";
}

}  // namespace
}  // namespace cabinet_articulation::core
