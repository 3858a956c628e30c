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

  /// What one frame takes after a few that are the same.
  evaluation::Allocations takenBy(SimulatedStereoCamera simulation, int frame) {
    const StereoFrame images = simulation.frame(frame);
    for (int i = 0; i < 5; ++i) process(images, simulation.camera());
    const evaluation::Allocations before = evaluation::allocations();
    process(images, simulation.camera());
    evaluation::Allocations taken = evaluation::allocations();
    taken.count -= before.count;
    return taken;
  }

  void process(const StereoFrame& images, const StereoCamera& camera) {
    const DepthFrame frame = stereo_.process(images.left, images.right, camera);
    const std::vector<PlaneRegion> regions = planes_.process(frame);
    const std::vector<DetectedRectangle> found = rectangles_.process(frame, regions, expected_);
    tracker_.process(stamp_ += 1.0 / 15, found);
    expected_.clear();
    for (const DetectedRectangle& detection : found) expected_.push_back(detection.rectangle);
    regions_ = regions.size();
  }

  const int threads_ = cv::getNumThreads();
  BlockMatcher stereo_{StereoConfig()};
  PlaneSegmenter planes_{PlanesConfig()};
  RectangleDetector rectangles_{RectanglesConfig(), PlanesConfig()};
  RectangleTracker tracker_{TrackingConfig()};
  std::vector<Rectangle> expected_;
  double stamp_ = 0;
  size_t regions_ = 0;
};

TEST_F(SteadyFrameMemory, AFrameTakesFewBlocksAndNoLargeOne) {
  SimulationConfig config;
  config.scene = "kitchen";
  config.rate = 5;
  const evaluation::Allocations taken = takenBy(SimulatedStereoCamera(config), 10);
  EXPECT_GT(regions_, 10U);
  EXPECT_FALSE(expected_.empty());
  EXPECT_LE(taken.count, 200);
  EXPECT_LE(taken.largest, 4096) << "[bytes]";
}

/// Sixteen fronts at different depths and an empty frame, which encloses a hole.
TEST_F(SteadyFrameMemory, NorDoesAClutteredOne) {
  constexpr double kPitch = 0.22, kSide = 0.2, kThickness = 0.018, kBar = 0.05;  // [m]
  Scene scene;
  const auto add = [&scene](double x, double y, double z, double width, double height) {
    addBox(boxBetween({x, y, z}, {x + width, y + kThickness, z + height}), 0.6, kFixedPart, &scene.surfaces);
  };
  addBox(boxBetween({-3, 0.4, -2}, {3, 0.5, 2}), 0.5, kFixedPart, &scene.surfaces);
  for (int column = -2; column < 2; ++column)
    for (int row = -2; row < 2; ++row) add(column * kPitch, (column + row) % 2 * 0.1, row * kPitch, kSide, kSide);
  for (const double z : {-0.4, 0.4}) add(-0.5, -0.2, z, 1, kBar);
  for (const double x : {-0.5, 0.5 - kBar}) add(x, -0.2, -0.4, kBar, 0.8);
  scene.view_point = {0.05, -1.3, 0.05};
  scene.view_target = {0, 0, 0};
  const evaluation::Allocations taken = takenBy(SimulatedStereoCamera({}, scene, MotionScript({}, 2)), 0);
  EXPECT_GT(regions_, 20U);
  EXPECT_GT(expected_.size(), 4U);
  EXPECT_LE(taken.count, 200);
  EXPECT_LE(taken.largest, 8192) << "[bytes] the list of regions, and what OpenCV takes for the hull of a ragged one";
}

}  // namespace
}  // namespace cabinet_articulation::core
