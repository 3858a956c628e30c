// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_segmenter.h"

#include <gtest/gtest.h>

#include <limits>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "geometry/degrees.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

/// A wall, a door ajar and a drawer front that stands out.
const std::vector<Patch> kScene = {{{0.002, 0.003, 33}, {-100, -100, 900, 700}},
                                   {{0.05, 0.001, 30}, {100, 50, 200, 300}},
                                   {{0.001, -0.02, 50}, {400, 200, 120, 50}}};

const SyntheticPair& pair() {
  static const SyntheticPair instance({640, 480}, kScene);
  return instance;
}

DepthFrame exactFrame() {
  DepthFrame frame;
  frame.camera = testCamera();
  frame.disparity = pair().disparity.clone();
  return frame;
}

DepthFrame stereoFrame() { return BlockMatcher(StereoConfig()).process(pair().left, pair().right, testCamera()); }

double normalError(const PlaneRegion& region, const Patch& patch) {
  return toDegrees(std::acos(std::min(1.0, region.plane.normal.dot(toPlane(patch.plane, testCamera())->normal))));
}

/// The region whose hull holds the middle of the patch and whose plane is nearest there.
const PlaneRegion* regionOf(const std::vector<PlaneRegion>& regions, const Patch& patch) {
  const double u = patch.area.x + patch.area.width / 2, v = patch.area.y + patch.area.height / 2;
  const PlaneRegion* best = nullptr;
  for (const PlaneRegion& region : regions)
    if (!best || std::abs(region.disparity_plane.at(u, v) - patch.plane.at(u, v)) <
                     std::abs(best->disparity_plane.at(u, v) - patch.plane.at(u, v)))
      best = &region;
  return best;
}

TEST(PlaneSegmenter, FindsEverySurfaceOnce) {
  const auto regions = PlaneSegmenter(PlanesConfig()).process(exactFrame());
  ASSERT_EQ(regions.size(), 3U);
  for (const Patch& patch : kScene) {
    const PlaneRegion* region = regionOf(regions, patch);
    EXPECT_LT(normalError(*region, patch), 0.01);
  }
  EXPECT_NEAR(regionOf(regions, kScene[2])->inliers, 120 * 50, 120 * 50 * 0.15) << "eroded by 2 px on every side";
}

TEST(PlaneSegmenter, LabelsPixelsInFrontInAndBehind) {
  DepthFrame frame = exactFrame();
  frame.disparity(cv::Rect(0, 0, 50, 50)) = 0;
  const auto regions = PlaneSegmenter(PlanesConfig()).process(frame);
  const PlaneRegion* door = regionOf(regions, kScene[1]);
  const PlaneRegion* wall = regionOf(regions, kScene[0]);
  EXPECT_EQ(door->mask(200, 200), kInPlane);
  EXPECT_EQ(door->mask(200, 600), kFree) << "the wall is behind the door's plane there";
  EXPECT_EQ(wall->mask(200, 600), kInPlane);
  EXPECT_EQ(wall->mask(220, 450), kOccluded) << "the drawer stands before the wall";
  EXPECT_EQ(wall->mask(10, 10), kUnknown);
  EXPECT_EQ(door->mask.size(), frame.disparity.size());
}

TEST(PlaneSegmenter, BearsHolesAllOverTheSurfaces) {
  const std::vector<cv::Rect> kInside = {{550, 50, 60, 300}, {130, 80, 140, 240}, {415, 212, 90, 26}};  // of the patches
  for (const bool stereo : {true, false})
    for (const int every : {5, 20}) {
      DepthFrame frame = stereo ? stereoFrame() : exactFrame();
      cv::RNG random(every);
      for (float& disparity : frame.disparity)
        if (random.uniform(0, every) == 0) disparity = 0;
      const auto regions = PlaneSegmenter(PlanesConfig()).process(frame);
      EXPECT_EQ(regions.size(), 3U) << stereo << every;
      for (size_t i = 0; i < kScene.size(); ++i) {
        const PlaneRegion* region = regionOf(regions, kScene[i]);
        ASSERT_NE(region, nullptr);
        EXPECT_LT(normalError(*region, kScene[i]), 0.4);
        EXPECT_GT(cv::countNonZero(region->mask(kInside[i]) == kInPlane), 0.95 * kInside[i].area());
      }
    }
}

TEST(PlaneSegmenter, StereoPairIsRefinedOnTheImages) {
  const DepthFrame frame = stereoFrame();
  const auto refined = PlaneSegmenter(PlanesConfig()).process(frame);
  PlanesConfig config;
  config.refine = false;
  const auto rough = PlaneSegmenter(config).process(frame);
  for (const Patch& patch : kScene) EXPECT_LT(normalError(*regionOf(refined, patch), patch), 0.4);
  EXPECT_LT(normalError(*regionOf(refined, kScene[2]), kScene[2]), normalError(*regionOf(rough, kScene[2]), kScene[2]));
}

TEST(PlaneSegmenter, TheSameFrameGivesTheSameBytesWhateverCameBefore) {
  const DepthFrame frame = stereoFrame(), other = exactFrame();
  PlaneSegmenter segmenter{PlanesConfig()};
  const auto first = segmenter.process(frame);
  segmenter.process(other);
  cv::setNumThreads(1);
  const auto again = segmenter.process(frame);
  ASSERT_EQ(first.size(), again.size());
  for (size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].plane.normal, again[i].plane.normal);
    EXPECT_EQ(first[i].plane.offset, again[i].plane.offset);
    EXPECT_EQ(first[i].inliers, again[i].inliers);
    EXPECT_EQ(first[i].hull, again[i].hull);
    EXPECT_EQ(cv::norm(first[i].mask, again[i].mask, cv::NORM_INF), 0);
    EXPECT_NE(first[i].mask.data, again[i].mask.data) << "masks are fresh memory";
  }
}

TEST(PlaneSegmenter, PaperMethodLabelsWholePlanesByTheirDistance) {
  PlanesConfig config;
  config.method = "paper";
  const DepthFrame frame = exactFrame();
  const auto regions = PlaneSegmenter(config).process(frame);
  const PlaneRegion* wall = regionOf(regions, kScene[0]);
  ASSERT_NE(wall, nullptr);
  int inliers = 0;
  for (int v = 0; v < frame.disparity.rows; ++v)
    for (int u = 0; u < frame.disparity.cols; ++u) {
      const double distance = wall->plane.distance(frame.camera.point(u, v, frame.disparity(v, u)));
      // Float disparities place a point 2 m away to within 1e-6 m.
      if (std::abs(std::abs(distance) - config.plane_distance) < 1e-5) continue;
      const Label expected = std::abs(distance) < config.plane_distance ? kInPlane : distance > 0 ? kOccluded : kFree;
      ASSERT_EQ(wall->mask(v, u), expected) << u << ' ' << v << ' ' << distance;
      inliers += expected == kInPlane;
    }
  EXPECT_NEAR(wall->inliers, inliers, 50);
  // The drawer in the middle belongs to the hull of the whole plane.
  EXPECT_GE(cv::pointPolygonTest(wall->hull, cv::Point2f(450, 220), false), 0);
}

/// Messages do not hold such planes, so they would be refused with all others of their frame.
TEST(PlaneSegmenter, SurfacesFartherThanAnyFrontAreNoRegions) {
  DepthFrame frame = exactFrame();
  const double too_far = 0.9 * frame.camera.focalBaseline() / limits::kPlaneOffset.max;
  frame.disparity(cv::Rect(0, 0, 640, 200)) = static_cast<float>(too_far);
  for (const char* method : {"local", "paper"}) {
    PlanesConfig config;
    config.method = method;
    for (const PlaneRegion& region : PlaneSegmenter(config).process(frame))
      EXPECT_LE(region.plane.offset, limits::kPlaneOffset.max) << method;
  }
}

TEST(PlaneSegmenter, ImagesOfAnotherSizeAreNamed) {
  DepthFrame frame = stereoFrame();
  frame.right = frame.right.colRange(0, 320);
  try {
    PlaneSegmenter(PlanesConfig()).process(frame);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("320x480"), std::string::npos) << error.what();
  }
}

TEST(PlaneSegmenter, WithoutDepthThereAreNoRegions) {
  DepthFrame frame;
  frame.camera = testCamera();
  PlanesConfig config;
  for (const char* method : {"local", "paper"}) {
    config.method = method;
    PlaneSegmenter segmenter{config};
    frame.disparity = cv::Mat1f();
    EXPECT_TRUE(segmenter.process(frame).empty());
    for (const float value : {0.0F, -3.0F, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
      frame.disparity = cv::Mat1f(480, 640, value);
      EXPECT_TRUE(segmenter.process(frame).empty()) << method << value;
    }
  }
}

/// Two plates of 400 x 300 px as a depth camera sees them: 2 m away, the right one nearer by `step`, with noise of 0.13 px that
/// is much the same over 9 px.
DepthFrame parallelPlates(double step) {
  DepthFrame frame;
  frame.camera = testCamera();
  const double focal_baseline = frame.camera.focalBaseline();
  cv::Mat1f noise(480, 640);
  cv::RNG(3).fill(noise, cv::RNG::NORMAL, 0, 1);
  cv::boxFilter(noise, noise, -1, {9, 9});
  frame.disparity = cv::Mat1f(480, 640, 0.0F);
  for (int v = 90; v < 390; ++v)
    for (int u = 120; u < 520; ++u)
      frame.disparity(v, u) = static_cast<float>(focal_baseline / (u > 300 ? 2 - step : 2) + 0.13 * 9 * noise(v, u));
  return frame;
}

TEST(PlaneSegmenter, TellsParallelFrontsApartByTheirStep) {
  for (const double step : {0.025, 0.03}) {
    const DepthFrame frame = parallelPlates(step);
    const auto regions = PlaneSegmenter(PlanesConfig()).process(frame);
    ASSERT_EQ(regions.size(), 2U) << step;
    const bool left_first = regions[0].hull[0].x < 300;
    const PlaneRegion &left = regions[left_first ? 0 : 1], &right = regions[left_first ? 1 : 0];
    // The blocks that hold the edge are 16 px wide; erosion and growing take or add 4 px.
    for (const cv::Point2f& corner : left.hull) EXPECT_LT(corner.x, 300 + 20);
    for (const cv::Point2f& corner : right.hull) EXPECT_GT(corner.x, 300 - 20);
    EXPECT_NEAR(left.disparity_plane.at(210, 240), frame.camera.focalBaseline() / 2, 0.05);
    EXPECT_NEAR(right.disparity_plane.at(410, 240), frame.camera.focalBaseline() / (2 - step), 0.05);
    EXPECT_EQ(left.mask(240, 210), kInPlane);
    EXPECT_EQ(right.mask(240, 410), kInPlane);
  }
  EXPECT_EQ(PlaneSegmenter(PlanesConfig()).process(parallelPlates(0)).size(), 1U);
}

}  // namespace
}  // namespace cabinet_articulation::core
