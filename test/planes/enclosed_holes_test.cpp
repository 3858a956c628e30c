// SPDX-License-Identifier: BSD-3-Clause
#include "planes/enclosed_holes.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/plane_region.h"

namespace cabinet_articulation::core {
namespace {

const cv::Rect kFront(100, 80, 120, 160), kPane(120, 100, 80, 120);  // [px] a frame of 20 px

/// The mask of a frame before what is behind it; `paint` changes it.
template <class Paint>
cv::Mat1b labelled(Paint&& paint, const cv::Rect& pane = kPane) {
  cv::Mat1b mask(320, 400, std::uint8_t{kFree});
  mask(kFront).setTo(kInPlane);
  mask(pane).setTo(kFree);
  paint(mask);
  std::vector<cv::Point> pixels;
  cv::findNonZero(mask == kInPlane, pixels);
  std::vector<cv::Point> hull;
  cv::convexHull(pixels, hull);
  EnclosedHoles().label({hull.begin(), hull.end()}, static_cast<int>(pixels.size()), &mask);
  return mask;
}

int holes(const cv::Mat1b& mask) { return cv::countNonZero(mask == kHole); }

TEST(EnclosedHoles, ThePaneIsAHoleAndTheRestStaysAsItIs) {
  const cv::Mat1b mask = labelled([](cv::Mat1b&) {});
  EXPECT_EQ(holes(mask), kPane.area());
  EXPECT_EQ(cv::countNonZero(mask(kPane) == kHole), kPane.area());
  EXPECT_EQ(cv::countNonZero(mask == kInPlane), kFront.area() - kPane.area());
}

TEST(EnclosedHoles, WhatStandsBeforeTheFrameOrInThePaneChangesNothing) {
  const auto arm = [](cv::Mat1b& mask) { cv::line(mask, {0, 300}, {150, 160}, cv::Scalar(kOccluded), 12); };
  EXPECT_GT(holes(labelled(arm)), 0.9 * kPane.area());
  const auto shelf = [](cv::Mat1b& mask) { mask(cv::Rect(120, 150, 80, 10)).setTo(kUnknown); };
  EXPECT_EQ(holes(labelled(shelf)), kPane.area() - 800) << "without a measurement nothing is known of it";
}

TEST(EnclosedHoles, AnOpenSideLetsTheOutsideIn) {
  const auto open_below = [](cv::Mat1b& mask) { mask(cv::Rect(120, 200, 80, 60)).setTo(kFree); };
  EXPECT_EQ(holes(labelled(open_below)), 0);
  const auto gap = [](cv::Mat1b& mask) { mask(cv::Rect(150, 80, 3, 20)).setTo(kUnknown); };
  EXPECT_EQ(holes(labelled(gap)), 0) << "a gap without measurements may be one";
}

TEST(EnclosedHoles, GapsOfASolidFrontAreNone) {
  EXPECT_EQ(holes(labelled([](cv::Mat1b&) {}, {150, 150, 20, 40})), 0);
}

TEST(EnclosedHoles, AtTheImagesBorderAndWithoutAHullNothingHappens) {
  cv::Mat1b mask(50, 50, std::uint8_t{kFree});
  EnclosedHoles holes_of;
  holes_of.label({}, 0, &mask);
  holes_of.label({{100, 100}, {200, 100}, {200, 200}}, 10, &mask);
  holes_of.label({{-20, -20}, {80, -20}, {80, 80}, {-20, 80}}, 10, &mask);
  EXPECT_EQ(holes(mask), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
