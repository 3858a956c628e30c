// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/round_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cabinet_articulation::core {
namespace {

constexpr int kSamples = 32;       ///< along the edge
constexpr int kFewest = 12;        ///< with depth
constexpr double kDeep = -20;      ///< [px] outward from the edge
constexpr double kInside = -7;     ///< [px] windows of block matching reach some 7 px, so that a step blurs no farther inside
constexpr double kOutside = 3;     ///< [px]
constexpr double kFarOutside = 8;  ///< [px]
constexpr float kBend = 0.12F;     ///< [px] of disparity; medians along the edges of flat fronts stay below
constexpr double kSlope = 3.6;     ///< depth over way at kOutside: 75 degrees, beyond which no surface is seen
constexpr double kFarSlope = 2.5;  ///< at kFarOutside: 68 degrees

constexpr double kNearOutside = 4;  ///< [px]
constexpr double kBeyond = 28;      ///< [px]
constexpr float kNoEdge = 0.3F;     ///< [px] at kNearOutside
constexpr float kFlat = 0.002F;     ///< [px/px] the same surface goes on
constexpr float kShallow = 0.008F;  ///< [px/px] a margin of 0.15 px is 4 cm there, at 1.3 m

/// Median of how much smaller the disparity is than the plane's, along a parallel to the edge.
float departure(const DepthFrame& frame, const DisparityPlane& plane, const ImageEdge& edge, double offset) {
  std::array<float, kSamples> values;
  int n = 0;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector2d pixel = edge.at((i + 0.5) / kSamples, offset);
    const auto u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= frame.disparity.cols || v >= frame.disparity.rows) continue;
    const float disparity = frame.disparity(v, u);
    if (disparity > 0) values[n++] = static_cast<float>(plane.at(u, v)) - disparity;
  }
  if (n < kFewest) return std::numeric_limits<float>::quiet_NaN();
  std::nth_element(values.begin(), values.begin() + n / 2, values.begin() + n);
  return values[n / 2];
}

/// Whether the surface goes on beyond the edge at so small an angle that nobody can say where it bends.
bool bendsShallowly(const DepthFrame& frame, const DisparityPlane& plane, const ImageEdge& edge) {
  const float near = departure(frame, plane, edge, kNearOutside);
  const float far = departure(frame, plane, edge, kBeyond);
  const float slope = (far - near) / static_cast<float>(kBeyond - kNearOutside);
  return std::abs(near) < kNoEdge && std::abs(slope) > kFlat && std::abs(slope) < kShallow;
}

}  // namespace

bool bendsAway(const DepthFrame& frame, const DisparityPlane& plane, const ImageEdge& edge) {
  if (frame.disparity.empty() || edge.depth < -kDeep) return false;
  if (bendsShallowly(frame, plane, edge)) return true;
  const float inside = departure(frame, plane, edge, kInside);
  const float outside = departure(frame, plane, edge, kOutside);
  const float far_outside = departure(frame, plane, edge, kFarOutside);
  // A way of one pixel is z / f, a change of depth by as much is B / z = d / f of disparity [px].
  const Eigen::Vector2d middle = (edge.a + edge.b) / 2;
  const double per_pixel = plane.at(middle.x(), middle.y()) / frame.camera.fx;
  return inside - departure(frame, plane, edge, kDeep) > kBend && outside > inside && far_outside > outside &&
         outside < kSlope * kOutside * per_pixel && far_outside < kFarSlope * kFarOutside * per_pixel;
}

}  // namespace cabinet_articulation::core
