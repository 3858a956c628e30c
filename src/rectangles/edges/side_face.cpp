// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/side_face.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/hal/hal.hpp>

namespace cabinet_articulation::core {
namespace {

constexpr int kStrips = EdgeProfile::kStrips;
constexpr double kThickness = 0.015;  ///< [m] of a thin front
constexpr double kMinWidth = 2;       ///< [px] of its side in the image that can be told from the front
constexpr double kMaxSlope = 1;       ///< [px/px] beyond, a face is left within a strip or two, as any other edge
constexpr double kReach = EdgeProfile::kOnPlane + 0.5;                               ///< [px]
constexpr int kFirst = 4;                                                            ///< strips that are the front's in any case
constexpr int kLongest = static_cast<int>(kLongestFace / EdgeProfile::kStripWidth);  ///< strips
constexpr float kUnexplained = 1.5F;         ///< log residual above the level that is as bad as any other
constexpr float kElsewhere = 0.9F;           ///< price of a strip that is neither front nor face
constexpr float kSmallestResidual = 0.015F;  ///< what interpolation alone leaves unexplained

/// Sum of log residuals by which a face must be better: the penalty of its two parameters in BIC. That is 5 nats, and a strip's
/// 128 pixels make 64 nats of a log residual.
constexpr float kEvidence = 0.1F;

constexpr double kLeastShare = 0.5;  ///< of the face that must be seen: what lies behind blends with its end (ours)

using Values = std::array<float, kStrips>;

/// Log residuals of all strips at one disparity within reach, by the parabola through three samples.
Values logResiduals(const EdgeProfile::Residuals& residuals, double disparity) {
  const int i = static_cast<int>(std::clamp(disparity + kReach, 1.0, EdgeProfile::kOffsets - 2.0));
  const auto x = static_cast<float>(disparity - (i - EdgeProfile::kOnPlane));
  Values values;
  for (int k = 0; k < kStrips; ++k) {
    const auto& samples = residuals.residual[k];
    const float slope = (samples[i + 1] - samples[i - 1]) / 2;
    const float curvature = samples[i + 1] - 2 * samples[i] + samples[i - 1];
    values[k] = std::max(samples[i] + x * slope + x * x * curvature / 2, kSmallestResidual);
  }
  cv::hal::log32f(values.data(), values.data(), kStrips);
  return values;
}

/// What it costs to say that each strip lies at this disparity, relative to saying that it lies elsewhere.
Values costs(const EdgeProfile::Residuals& residuals, double level, double disparity) {
  Values values = logResiduals(residuals, disparity);
  for (int k = 0; k < kStrips; ++k)
    values[k] = residuals.weight[k] * (std::min(values[k] - static_cast<float>(level), kUnexplained) - kElsewhere);
  return values;
}

}  // namespace

SideFace sideFace(const PlaneChart& chart, const StereoCamera& camera, const DisparityPlane& plane,
                  const PlaneRectangle& rectangle, Edge edge) {
  const std::optional<ImageEdge> image = imageEdge(chart, rectangle, edge);
  if (!image) return {};
  const Eigen::Vector2d middle = rectangle.center + rectangle.outward(edge) * (rectangle.side(edgeAxis(edge)) / 2);
  const Eigen::Vector3d front = chart.pose() * Eigen::Vector3d(middle.x(), middle.y(), 0);
  const Eigen::Vector3d back = chart.pose() * Eigen::Vector3d(middle.x(), middle.y(), -kThickness);
  const Eigen::Vector2d pixel = camera.project(back);
  const double width = image->outward.dot(pixel - camera.project(front));
  if (width < kMinWidth) return {};
  const double slope = (camera.disparity(back.z()) - plane.at(pixel.x(), pixel.y())) / width;
  return slope > -kMaxSlope && slope < 0 ? SideFace{slope, width} : SideFace{};
}

std::optional<int> sideFaceBegin(const EdgeProfile::Residuals& residuals, double level, const SideFace& face) {
  if (face.slope >= 0) return std::nullopt;
  const double in_reach = kReach / (-face.slope * EdgeProfile::kStripWidth);
  const double shortest = std::min({kLeastShare * face.width / EdgeProfile::kStripWidth, in_reach - 1, double{kLongest}});
  const Values plane = costs(residuals, level, 0);
  Values before;  // of the strips before each
  float best_plane = 0, sum = 0;
  for (int k = 0; k < kStrips; ++k) {
    before[k] = sum;
    sum += plane[k];
    best_plane = std::min(best_plane, sum);
  }
  // All faces grow by a strip at a time, so that each disparity is looked at once.
  Values with_face = before;
  float best_face = best_plane - kEvidence;
  std::optional<int> best;
  for (int length = 0; length < kLongest; ++length) {
    const double disparity = face.slope * (length + 0.5) * EdgeProfile::kStripWidth;
    if (disparity < -kReach) break;
    const Values on_face = costs(residuals, level, disparity);
    for (int begin = kFirst; begin + length < kStrips; ++begin) {
      with_face[begin] += on_face[begin + length];
      if (length + 1 < shortest || with_face[begin] >= best_face) continue;
      best_face = with_face[begin];
      best = begin;
    }
  }
  return best;
}

}  // namespace cabinet_articulation::core
