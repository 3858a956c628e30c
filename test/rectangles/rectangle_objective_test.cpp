// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/rectangle_objective.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "cabinet_articulation/planes/plane_region.h"
#include "rectangles/chart/image_spans.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kWidth = 64;
constexpr int kHeight = 48;

cv::Mat1b randomMask() {
  constexpr std::uint8_t kLabels[] = {kFree, kUnknown, kOtherPlane, kOccluded, kInPlane};
  std::mt19937 random(3);
  cv::Mat1b mask(kHeight, kWidth);
  for (std::uint8_t& value : mask) value = kLabels[random() % 5];
  return mask;
}

ImageQuad turnedBox(double u, double v, double width, double height, double angle) {
  ImageQuad quad;
  const double x[] = {-width / 2, width / 2, width / 2, -width / 2};
  const double y[] = {-height / 2, -height / 2, height / 2, height / 2};
  for (int i = 0; i < 4; ++i)
    quad[i] = {u + std::cos(angle) * x[i] - std::sin(angle) * y[i], v + std::sin(angle) * x[i] + std::cos(angle) * y[i]};
  return quad;
}

/// The same question asked pixel by pixel.
bool inside(const ImageQuad& quad, double u, double v) {
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d edge = quad[(i + 1) % 4] - quad[i];
    const Eigen::Vector2d to = Eigen::Vector2d(u, v) - quad[i];
    if (edge.x() * to.y() - edge.y() * to.x() < 0) return false;
  }
  return true;
}

double weightOf(std::uint8_t label, const RectanglesConfig& config) {
  switch (label) {
    case kInPlane:
      return 1;
    case kFree:
      return config.weight_free;
    case kOtherPlane:
      return config.weight_other_plane;
    case kOccluded:
      return config.weight_occluded;
    default:
      return config.weight_unknown;
  }
}

TEST(RectangleObjectiveTest, AddsUpTheLabelsInsideTheRectangle) {
  const cv::Mat1b mask = randomMask();
  const RectanglesConfig config;
  RectangleObjective objective(config);
  objective.setMask(mask);
  for (int i = 0; i < 60; ++i) {
    // Angles through all quadrants, some boxes leaving the image on each side. The shifts keep borders off pixel centres.
    const ImageQuad quad = turnedBox(5.3 + 0.9 * i, 45.7 - 0.7 * i, 9.1 + 0.4 * i, 7.3 + 0.2 * i, 0.11 * i + 0.01);
    double expected = 0;
    int pixels = 0, in_plane = 0, unknown = 0;
    for (int v = 0; v < kHeight; ++v)
      for (int u = 0; u < kWidth; ++u)
        if (inside(quad, u, v)) {
          expected += weightOf(mask(v, u), config);
          ++pixels;
          in_plane += mask(v, u) == kInPlane;
          unknown += mask(v, u) == kUnknown;
        }
    expected += config.weight_unknown * std::max(0.0, area(quad) - pixels);
    EXPECT_NEAR(objective.gain(quad), expected, 1e-6) << i;
    const LabelCounts counts = objective.count(quad);
    EXPECT_EQ(counts.total(), pixels) << i;
    EXPECT_EQ(counts.in_plane, in_plane) << i;
    EXPECT_EQ(counts.unknown, unknown) << i;
  }
}

TEST(RectangleObjectiveTest, CountsAnAxisAlignedBox) {
  RectangleObjective objective(RectanglesConfig{});
  const cv::Mat1b mask(kHeight, kWidth, std::uint8_t{kInPlane});
  objective.setMask(mask);
  EXPECT_EQ(objective.count({{{1.6, 2.6}, {5.4, 2.6}, {5.4, 8.4}, {1.6, 8.4}}}).in_plane, 4 * 6);
}

TEST(RectangleObjectiveTest, HasNothingToSayOutsideTheImage) {
  RectangleObjective objective(RectanglesConfig{});
  const cv::Mat1b mask(kHeight, kWidth, std::uint8_t{kInPlane});
  objective.setMask(mask);
  EXPECT_EQ(objective.gain(turnedBox(-50, -50, 20, 20, 0.3)), -std::numeric_limits<double>::infinity());
  EXPECT_EQ(objective.count(turnedBox(500, 20, 20, 20, 0)).total(), 0);
}

TEST(RectangleObjectiveTest, CornersMayBeAnywhere) {
  const double kHuge = std::numeric_limits<double>::max() / 4;
  const double places[] = {-kHuge, -1e10, -1, 20, 1e10, kHuge};
  const cv::Mat1b mask = randomMask();
  RectangleObjective objective{RectanglesConfig()};
  objective.setMask(mask);
  for (const double u : places)
    for (const double v : places)
      for (const double width : {1e-3, 10.0, 1e10, kHuge}) {
        const ImageQuad quad{{{u, v}, {u + width, v}, {u + width, v + width}, {u, v + width}}};
        for (const int row_step : {1, 8}) {
          const std::int64_t before = objective.rowsSeen();
          objective.gain(quad, row_step);
          EXPECT_LE(objective.rowsSeen() - before, kHeight);
        }
        EXPECT_LE(objective.count(quad).total(), kWidth * kHeight);
      }
  const ImageQuad all{{{-kHuge, -kHuge}, {kHuge, -kHuge}, {kHuge, kHuge}, {-kHuge, kHuge}}};
  EXPECT_EQ(objective.count(all).total(), kWidth * kHeight);
}

TEST(RectangleObjectiveTest, PaperObjectiveIsTheOriginalReleasesEq3) {
  RectanglesConfig config;
  config.objective = "paper";
  RectangleObjective objective(config);
  cv::Mat1b mask(kHeight, kWidth, std::uint8_t{kInPlane});
  mask.rowRange(8, 10).setTo(kOccluded);
  mask.rowRange(6, 8).setTo(kFree);
  objective.setMask(mask);
  const ImageQuad quad{
      {{1.6, 3.6}, {11.4, 3.6}, {11.4, 13.4}, {1.6, 13.4}}};  // 10 x 10 pixels: 60 in-plane, 20 occluded, 20 free
  EXPECT_NEAR(objective.gain(quad), (60 + 0.8 * 20) / std::pow(100, 0.95), 1e-9);
  EXPECT_EQ(objective.gain(turnedBox(1, 20, 10, 10, 0)), -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace cabinet_articulation::core
