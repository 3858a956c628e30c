// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/rectangle_detector.h"

#include <gtest/gtest.h>

#include "front_scene.h"
#include "hinged_door.h"

namespace cabinet_articulation::core {
namespace {

/// Masks without images: what the search alone does. At 1.3 m a pixel is 1.9 mm, so exact masks give corners within
/// a pixel and a half.
constexpr double kCornerTolerance = 0.003;

class RectangleDetectorTest : public testing::Test {
 protected:
  RectangleDetectorTest() {
    frame_.camera = exampleCamera();
    frame_.disparity = cv::Mat1f(frame_.camera.height, frame_.camera.width, std::numeric_limits<float>::quiet_NaN());
  }

  std::vector<DetectedRectangle> detect(const PlaneRegion& region) {
    return RectangleDetector(config_, planes_).process(frame_, {region});
  }

  RectanglesConfig config_;
  PlanesConfig planes_;
  DepthFrame frame_;
};

TEST_F(RectangleDetectorTest, FindsFrontsOfAllTurnsAndTilts) {
  int k = 0;
  for (const double roll : {0.0, 0.3, 0.8, 1.5, -0.6})
    for (const double yaw : {0.0, 0.7, -1.0}) {
      const Rectangle front = exampleFront({0.02 * (k % 5) - 0.04, 0.03, 1.3}, 0.4, k % 2 == 0 ? 0.13 : 0.3, yaw, 0.2, roll);
      ++k;
      const auto found = detect(finishRegion(frontRegion(front, frame_.camera)));
      ASSERT_EQ(found.size(), 1U) << roll << " " << yaw;
      EXPECT_LT(cornerError(front, found[0].rectangle), kCornerTolerance / std::cos(yaw)) << roll << " " << yaw;
      EXPECT_GT(found[0].precision, 0.98);
      EXPECT_GT(found[0].recall, 0.98);
      for (const float support : found[0].edge_support) EXPECT_GT(support, 0.95);
    }
}

TEST_F(RectangleDetectorTest, ABarAcrossTheFrontDoesNotSplitIt) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0.3, 0, 0.1);
  PlaneRegion region = frontRegion(front, frame_.camera);
  const cv::Point middle(318, 243);
  cv::line(region.mask, middle - cv::Point(30, 200), middle + cv::Point(30, 200), cv::Scalar(kOccluded), 30);  // 6 cm wide
  const auto found = detect(finishRegion(region));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(cornerError(front, found[0].rectangle), kCornerTolerance);
  // The bar covers some 15 % of the long edges.
  const Rectangle aligned = alignDescription(found[0].rectangle, front, false);
  EXPECT_NEAR(aligned.width, 0.4, kCornerTolerance);
  EXPECT_LT(*std::min_element(found[0].edge_support.begin(), found[0].edge_support.end()), 0.92F);
}

TEST_F(RectangleDetectorTest, HolesWithoutDepthDoNotMatter) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.35, 0.25, -0.2, 0.2, 0);
  PlaneRegion region = frontRegion(front, frame_.camera);
  cv::circle(region.mask, {300, 240}, 25, cv::Scalar(kUnknown), cv::FILLED);
  cv::rectangle(region.mask, {350, 250, 40, 12}, cv::Scalar(kUnknown), cv::FILLED);
  const auto found = detect(finishRegion(region));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(cornerError(front, found[0].rectangle), kCornerTolerance);
}

/// A glass door: a frame of 4 cm before what is behind the pane, which counts for nothing.
PlaneRegion frameAround(const Rectangle& front, const StereoCamera& camera, std::uint8_t behind) {
  PlaneRegion region = frontRegion(front, camera);
  Rectangle pane = front;
  pane.width -= 0.08;
  pane.height -= 0.08;
  region.mask.setTo(behind, footprint(pane, camera));
  return region;
}

TEST_F(RectangleDetectorTest, AFrameAroundAHoleIsAHollowFront) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.35, 0.4, 0.5, 0, 0.05);
  const auto found = detect(finishRegion(frameAround(front, frame_.camera, kHole)));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(found[0].hollow);
  EXPECT_LT(cornerError(front, found[0].rectangle), kCornerTolerance);
  EXPECT_TRUE(detect(finishRegion(frameAround(front, frame_.camera, kFree))).empty()) << "the outside is no hole";
}

TEST_F(RectangleDetectorTest, AHoleNeedsThreeEdgesAroundIt) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.35, 0.4, 0, 0, 0);
  PlaneRegion region = frameAround(front, frame_.camera, kHole);
  const cv::Rect box = cv::boundingRect(footprint(front, frame_.camera));
  // Walls go on to the left and above.
  region.mask(cv::Rect(0, box.y, box.x, box.height)).setTo(kOccluded);
  EXPECT_EQ(detect(finishRegion(region)).size(), 1U);
  region.mask(cv::Rect(0, 0, 640, box.y)).setTo(kOccluded);
  EXPECT_TRUE(detect(finishRegion(region)).empty());
}

TEST_F(RectangleDetectorTest, ANeighbourInTheSamePlaneIsLeftToItsOwnRegion) {
  const Rectangle front = exampleFront({-0.1, 0, 1.3}, 0.3, 0.3, 0, 0, 0);
  const Rectangle neighbour = exampleFront({0.2, 0, 1.3}, 0.3, 0.3, 0, 0, 0);
  PlaneRegion region = finishRegion(frontRegion(front, frame_.camera));
  region.mask.setTo(kOtherPlane, footprint(neighbour, frame_.camera));
  const auto found = detect(region);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(cornerError(front, found[0].rectangle), kCornerTolerance);
}

TEST_F(RectangleDetectorTest, TwoFrontsInOnePlaneAreFoundFromTheirOwnRegions) {
  const Rectangle fronts[] = {exampleFront({-0.18, 0, 1.3}, 0.3, 0.3, 0, 0, 0), exampleFront({0.18, 0, 1.3}, 0.3, 0.2, 0, 0, 0)};
  std::vector<PlaneRegion> regions;
  for (const Rectangle& front : fronts) {
    PlaneRegion region = finishRegion(frontRegion(front, frame_.camera));
    for (const Rectangle& other : fronts) region.mask.setTo(kInPlane, footprint(other, frame_.camera));
    regions.push_back(region);
  }
  const auto found = RectangleDetector(config_, planes_).process(frame_, regions);
  ASSERT_EQ(found.size(), 2U);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(found[i].region, i);  // the larger one is better supported, so first
    EXPECT_LT(cornerError(fronts[i], found[i].rectangle), kCornerTolerance);
  }
}

TEST_F(RectangleDetectorTest, OneSurfaceSegmentedTwiceIsReportedOnce) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.3, 0.3, 0.3, 0, 0);
  const Rectangle tilted = exampleFront({0, 0, 1.305}, 0.3, 0.28, 0.33, 0, 0);
  const auto found =
      RectangleDetector(config_, planes_)
          .process(frame_, {finishRegion(frontRegion(tilted, frame_.camera)), finishRegion(frontRegion(front, frame_.camera))});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].region, 1);
}

TEST_F(RectangleDetectorTest, AnEdgeCutByTheImageIsNotObservedAndTheCovarianceSaysSo) {
  const Rectangle front = exampleFront({0.55, 0, 1.3}, 0.4, 0.3, 0, 0, 0);  // its right third lies outside
  const auto found = detect(finishRegion(frontRegion(front, frame_.camera)));
  ASSERT_EQ(found.size(), 1U);
  const Rectangle aligned = alignDescription(found[0].rectangle, front, false);
  EXPECT_NEAR(aligned.height, 0.3, kCornerTolerance);
  const Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  int unseen = 0;
  for (int edge = 0; edge < 4; ++edge) {
    const Eigen::Vector3d outward = found[0].rectangle.pose.linear().col(edge / 2) * (edge % 2 == 0 ? -1 : 1);
    if (outward.dot(right) > 0.9) {
      EXPECT_LT(found[0].edge_support[edge], 0.05);
      ++unseen;
    } else {
      EXPECT_GT(found[0].edge_support[edge], 0.9);
    }
  }
  EXPECT_EQ(unseen, 1);
  // Along the image's x axis the true centre is 3-4 cm away; up and down it is known to a few millimetres.
  const double error = found[0].rectangle.center().x() - front.center().x();
  EXPECT_LT(std::abs(error), 2 * std::sqrt(found[0].covariance(0, 0)));
  EXPECT_GT(std::sqrt(found[0].covariance(0, 0)), 0.1);
  EXPECT_LT(std::sqrt(found[0].covariance(1, 1)), 0.005);
}

TEST_F(RectangleDetectorTest, ATracksSizeIsUsedWhereAnArmHidesTheFront) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.5, 0.5, 0, 0);
  PlaneRegion region = frontRegion(front, frame_.camera);
  region.mask.rowRange(270, 480).setTo(kOccluded);  // the lower 40 % and everything below
  region = finishRegion(region);
  Rectangle expected = front;
  expected.pose.translation() += Eigen::Vector3d(0.03, -0.02, 0.01);
  const auto alone = RectangleDetector(config_, planes_).process(frame_, {region});
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_GT(cornerError(front, alone[0].rectangle), 0.1);
  const auto guided = RectangleDetector(config_, planes_).process(frame_, {region}, {expected});
  ASSERT_EQ(guided.size(), 1U);
  EXPECT_LT(cornerError(front, guided[0].rectangle), 0.01);
}

TEST_F(RectangleDetectorTest, ATracksSizeIsUsedWhereADoorGoesBehindItsNeighbour) {
  const HingedDoor scene(1.2);
  ASSERT_GT(scene.hidden, 0.01);
  const Rectangle wall = exampleFront({0, 0, 1.8}, 3, 3, 0, 0, 0);
  const std::vector<TexturedRectangle> surfaces{{scene.door, 1}, {scene.neighbour, 2}, {wall, 3}};
  frame_.left = renderView(surfaces, frame_.camera, false);
  frame_.right = renderView(surfaces, frame_.camera, true);
  PlaneRegion door = frontRegion(scene.door, frame_.camera);
  door.mask.setTo(kOccluded, footprint(scene.neighbour, frame_.camera));
  const std::vector<PlaneRegion> regions{finishRegion(door), finishRegion(frontRegion(scene.neighbour, frame_.camera))};
  const auto widthOf = [&](const std::vector<DetectedRectangle>& found) {
    for (const DetectedRectangle& detection : found)
      if (detection.region == 0) return alignDescription(detection.rectangle, scene.door, true).width;
    return 0.0;
  };
  RectangleDetector detector(config_, planes_);
  EXPECT_NEAR(widthOf(detector.process(frame_, regions)), scene.door.width - scene.hidden, 0.004);
  EXPECT_NEAR(widthOf(detector.process(frame_, regions, {scene.door})), scene.door.width, 0.001);
}

TEST_F(RectangleDetectorTest, TracksAreNotAskedWhereTheyAreNotWanted) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.5, 0.5, 0, 0);
  PlaneRegion region = frontRegion(front, frame_.camera);
  region.mask.rowRange(270, 480).setTo(kOccluded);
  region = finishRegion(region);
  const auto alone = RectangleDetector(config_, planes_).process(frame_, {region});
  config_.use_tracks = false;
  const auto unguided = RectangleDetector(config_, planes_).process(frame_, {region}, {front});
  ASSERT_EQ(alone.size(), 1U);
  ASSERT_EQ(unguided.size(), 1U);
  EXPECT_EQ(unguided[0].rectangle.pose.matrix(), alone[0].rectangle.pose.matrix());
  EXPECT_EQ(unguided[0].rectangle.height, alone[0].rectangle.height);
  EXPECT_EQ(unguided[0].covariance, alone[0].covariance);
}

TEST_F(RectangleDetectorTest, PlanesOfSmallFrontsAreRefinedBySettingsOfThePlanesStage) {
  const Rectangle front = exampleFront({0, 0, 1.4}, 0.3, 0.15, 0.3, 0.2, 0.1);
  const Rectangle wall = exampleFront({0, 0, 1.8}, 3, 3, 0, 0, 0);
  frame_.left = renderView({{front, 1}, {wall, 2}}, frame_.camera, false);
  frame_.right = renderView({{front, 1}, {wall, 2}}, frame_.camera, true);
  Rectangle tilted = front;
  tilted.pose.linear() *= Eigen::AngleAxisd(0.15, Eigen::Vector3d(1, 1, 0).normalized()).toRotationMatrix();
  PlaneRegion region = frontRegion(front, frame_.camera);
  region.plane = tilted.plane();
  region.disparity_plane = *toDisparityPlane(region.plane, frame_.camera);
  config_.refine_edges = false;
  const auto tilt = [&] {
    const auto found = RectangleDetector(config_, planes_).process(frame_, {finishRegion(region)});
    return found.size() == 1 ? std::acos(std::min(1.0, found[0].rectangle.normal().dot(front.normal()))) : std::nan("");
  };
  EXPECT_LT(tilt(), 0.02);
  planes_.refine_max_shift = 0.01;  // of [px]: none that would help
  EXPECT_GT(tilt(), 0.14);
}

TEST_F(RectangleDetectorTest, AnObservedSizeBeatsARememberedOne) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0.3, 0, 0);
  Rectangle expected = front;
  expected.width = 0.32;
  const std::vector<PlaneRegion> regions{finishRegion(frontRegion(front, frame_.camera))};
  const auto found = RectangleDetector(config_, planes_).process(frame_, regions, {expected});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT(cornerError(front, found[0].rectangle), kCornerTolerance);
}

TEST_F(RectangleDetectorTest, RejectsWhatIsNoRectangle) {
  PlaneRegion region = frontRegion(exampleFront({0, 0, 1.3}, 0.4, 0.4, 0, 0, 0), frame_.camera);
  PlaneRegion disc = region;
  disc.mask = cv::Mat1b(region.mask.size(), std::uint8_t{kFree});
  cv::ellipse(disc.mask, {318, 243}, {120, 120}, 0, 0, 270, cv::Scalar(kInPlane), cv::FILLED);
  EXPECT_TRUE(detect(finishRegion(disc)).empty());
  config_.max_side = 1.2;
  EXPECT_TRUE(
      detect(finishRegion(frontRegion(exampleFront({0, 0, 1.3}, 0.4, 0.04, 0, 0, 0), frame_.camera))).empty());       // too thin
  EXPECT_TRUE(detect(finishRegion(frontRegion(exampleFront({0, 0, 3}, 1.3, 0.9, 0, 0, 0), frame_.camera))).empty());  // too long
}

TEST_F(RectangleDetectorTest, KeepsAtMostTheGivenNumber) {
  std::vector<PlaneRegion> regions;
  for (const double x : {-0.35, 0.0, 0.35})
    regions.push_back(finishRegion(frontRegion(exampleFront({x, 0, 1.3}, 0.25, 0.25 + x / 10, 0, 0, 0), frame_.camera)));
  config_.max_rectangles = 2;
  const auto found = RectangleDetector(config_, planes_).process(frame_, regions);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].region, 2);
  EXPECT_EQ(found[1].region, 1);
}

TEST_F(RectangleDetectorTest, ATimeBudgetGoesToTracksAndLargeRegionsFirst) {
  std::vector<Rectangle> fronts;
  std::vector<PlaneRegion> regions;
  for (const double x : {-0.35, 0.0, 0.35}) {
    fronts.push_back(exampleFront({x, 0, 1.3}, 0.25, 0.25 + x / 10, 0, 0, 0));
    regions.push_back(finishRegion(frontRegion(fronts.back(), frame_.camera)));
  }
  const auto found = [&](double milliseconds, const std::vector<Rectangle>& expected) {
    config_.time_budget = milliseconds;
    std::vector<int> result;
    for (const DetectedRectangle& rectangle : RectangleDetector(config_, planes_).process(frame_, regions, expected))
      result.push_back(rectangle.region);
    return result;
  };
  EXPECT_EQ(found(0.1, {}), (std::vector<int>{2}));           // one rectangle costs some 0.4 ms
  EXPECT_EQ(found(0.1, {fronts[0]}), (std::vector<int>{0}));  // the smallest, but tracked
  EXPECT_EQ(found(0.6, {}), (std::vector<int>{2, 1}));
  EXPECT_EQ(found(100, {}), found(0, {}));
}

TEST_F(RectangleDetectorTest, RandomStartsAreReproducibleAndFindTheFrontWithThePapersObjective) {
  config_.objective = "paper";
  config_.random_starts = 5;
  config_.min_precision = 0.7;
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0.3, 0, 0.2);
  const std::vector<PlaneRegion> regions{finishRegion(frontRegion(front, frame_.camera))};
  RectangleDetector detector(config_, planes_);
  const auto first = detector.process(frame_, regions);
  ASSERT_EQ(first.size(), 1U);
  EXPECT_GT(intersectionOverUnion(front, first[0].rectangle), 0.8);  // Eq. (3) itself likes to grow a little over free space
  const auto again = detector.process(frame_, regions);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(first[0].rectangle.pose.matrix(), again[0].rectangle.pose.matrix());
  EXPECT_EQ(first[0].covariance, again[0].covariance);
}

TEST_F(RectangleDetectorTest, NothingComesOfNothing) {
  RectangleDetector detector(config_, planes_);
  EXPECT_TRUE(detector.process(frame_, {}).empty());
  PlaneRegion empty = frontRegion(exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0), frame_.camera);
  empty.mask.setTo(kUnknown);
  EXPECT_TRUE(detector.process(frame_, {finishRegion(empty)}).empty());
  empty.mask.setTo(kFree);
  EXPECT_TRUE(detector.process(frame_, {finishRegion(empty)}).empty());
}

TEST_F(RectangleDetectorTest, RefusesSizesThatDoNotMatch) {
  RectangleDetector detector(config_, planes_);
  PlaneRegion region = finishRegion(frontRegion(exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0), frame_.camera));
  region.mask = region.mask.rowRange(0, 100);
  EXPECT_THROW(detector.process(frame_, {region}), std::invalid_argument);
  frame_.left = cv::Mat1b(10, 10);
  EXPECT_THROW(detector.process(frame_, {}), std::invalid_argument);
  config_.min_precision = 1.5;
  EXPECT_THROW((RectangleDetector{config_, planes_}), ConfigError);
  config_ = {};
  planes_.refine_iterations = 0;
  EXPECT_THROW((RectangleDetector{config_, planes_}), ConfigError);
}

}  // namespace
}  // namespace cabinet_articulation::core
