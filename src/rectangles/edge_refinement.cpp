// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/edge_refinement.h"

#include <algorithm>
#include <cmath>

#include "cabinet_articulation/rectangles/edge_step.h"
#include "cabinet_articulation/rectangles/side_face.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kPasses = 2;                ///< the second starts from the first's edges and turn
constexpr double kSettled = 1;            ///< [px] a smaller change needs no second pass
constexpr double kMaxTurn = 0.1;          ///< [rad] a larger turn is a mismatch
constexpr double kHalfSigma = 0.7;        ///< [px] of the place of half an edge
constexpr double kMaskTurnSigma = 0.006;  ///< [rad] of the turn that the mask gave
constexpr double kHalfDistance = 0.5;     ///< of an edge's length, between the middles of its halves

struct EdgeShift {
  bool confirmed = false;
  double distance = 0;  ///< [m] outward
  double turn = 0;      ///< [rad] counter-clockwise
  double turn_weight = 0;
};

bool trusted(const EdgeStep& step, const RectanglesConfig& config) {
  return step.contrast > config.edge_contrast && step.inside < std::log(1 - config.edge_agreement);
}

EdgeShift measure(const PlaneChart& chart, const PlaneRegion& region, const DepthFrame& frame, const PlaneRectangle& rectangle,
                  Edge edge, const RectanglesConfig& config) {
  EdgeShift shift;
  const std::optional<ImageEdge> image = imageEdge(chart, rectangle, edge);
  if (!image) return shift;
  const EdgeProfile profile(frame, region, *image);
  const double face_slope = sideFaceSlope(chart, frame.camera, region.disparity_plane, rectangle, edge);
  const EdgeStep step = findStep(profile.whole(), face_slope);
  if (!trusted(step, config)) return shift;
  shift.confirmed = true;
  shift.distance = step.offset * image->metres_per_pixel;
  const EdgeStep first = findStep(profile.half(0), face_slope);
  const EdgeStep second = findStep(profile.half(1), face_slope);
  if (!trusted(first, config) || !trusted(second, config)) return shift;
  if (first.face != step.face || second.face != step.face) return shift;
  // The edge runs counter-clockwise, so if its second half lies further out the rectangle must turn clockwise.
  const double length = rectangle.side(1 - edgeAxis(edge));
  shift.turn = -(second.offset - first.offset) * image->metres_per_pixel / (kHalfDistance * length);
  shift.turn_weight = std::pow(kHalfDistance * length / (kHalfSigma * image->metres_per_pixel), 2) / 2;
  return shift;
}

}  // namespace

RefinedRectangle refineEdges(const PlaneChart& chart, const PlaneRegion& region, const DepthFrame& frame,
                             const PlaneRectangle& rectangle, const RectanglesConfig& config) {
  RefinedRectangle result;
  result.rectangle = rectangle;
  if (frame.left.empty() || frame.right.empty()) return result;
  for (int pass = 0; pass < kPasses; ++pass) {
    const PlaneRectangle start = result.rectangle;
    double turn = 0, weight = 1 / (kMaskTurnSigma * kMaskTurnSigma), moved = 0;
    for (const Edge edge : kEdges) {
      const EdgeShift shift = measure(chart, region, frame, start, edge, config);
      result.confirmed[edge] = shift.confirmed;
      result.rectangle.moveEdge(edge, shift.distance);
      moved = std::max(moved, std::abs(shift.distance));
      turn += shift.turn_weight * shift.turn;
      weight += shift.turn_weight;
    }
    if (weight > 0 && std::abs(turn / weight) < kMaxTurn) {
      result.rectangle.angle += turn / weight;
      moved = std::max(moved, std::abs(turn / weight) * std::hypot(start.width, start.height) / 2);
    }
    if (moved * chart.pixelsPerMetre() < kSettled) break;
  }
  return result;
}

}  // namespace cabinet_articulation::core
