// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/edge_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/board.h"
#include "rectangles/edges/crease.h"
#include "rectangles/edges/depth_edge.h"
#include "rectangles/edges/edge_step.h"
#include "rectangles/edges/side_face.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kPasses = 2;                ///< the second starts from the first's edges and turn
constexpr double kSettled = 0.5;          ///< [px] a smaller change needs no second pass
constexpr double kMaxTurn = 0.1;          ///< [rad] a larger turn is a mismatch
constexpr double kHalfSigma = 0.3;        ///< [px] of the place of half an edge
constexpr double kMaskTurnSigma = 0.006;  ///< [rad] of the turn that the mask gave
constexpr double kMostSkew = 3;           ///< [px] between an edge's halves; more, and something lies over one of them
constexpr double kTolerance = 2;          ///< [px] of a crease's place by the planes alone
constexpr double kHalfDistance = 0.5;     ///< of an edge's length, between the middles of its halves

/// Where the strips leave the plane. Both halves of an edge must do so for the same reason.
struct Border {
  double offset;  ///< [px]
  bool face = false;
  double nearer = 0;  ///< [px]
};

struct EdgeShift {
  std::optional<Border> border;
  double distance = 0;           ///< [m] outward
  std::optional<double> hidden;  ///< [m]
  double turn = 0;               ///< [rad] counter-clockwise
  double turn_weight = 0;
};

/// What the whole of an edge and its halves say. Nobody asks the halves of an edge without a border, nor the second after the
/// first has none.
using Borders = std::array<std::optional<Border>, 3>;

template <class Find, class FindInHalf>
Borders bordersOf(const Find& find_in_whole, const FindInHalf& find_in_half) {
  Borders borders;
  borders[0] = find_in_whole();
  if (borders[0]) borders[1] = find_in_half(0);
  if (borders[1]) borders[2] = find_in_half(1);
  return borders;
}

/// An edge by the whole, and a turn by the halves.
EdgeShift shiftTo(const Borders& borders, const ImageEdge& image, double length) {
  const auto& [whole, first, second] = borders;
  EdgeShift shift;
  if (!whole) return shift;
  shift.border = whole;
  shift.distance = whole->offset * image.metres_per_pixel;
  if (!first || !second || first->face != whole->face || second->face != whole->face) return shift;
  if (std::abs(second->offset - first->offset) > kMostSkew) {
    shift.distance = std::max(first->offset, second->offset) * image.metres_per_pixel;
    return shift;
  }
  // The edge runs counter-clockwise, so if its second half lies further out the rectangle must turn clockwise.
  shift.turn = -(second->offset - first->offset) * image.metres_per_pixel / (kHalfDistance * length);
  shift.turn_weight = std::pow(kHalfDistance * length / (kHalfSigma * image.metres_per_pixel), 2) / 2;
  return shift;
}

Borders findBorders(const EdgeProfile& profile, const SideFace& face, const RectanglesConfig& config) {
  const auto find = [&](const EdgeProfile::Residuals& residuals) -> std::optional<Border> {
    const EdgeStep step = findStep(residuals, face);
    if (step.contrast <= config.edge_contrast || step.inside >= std::log(1 - config.edge_agreement)) return std::nullopt;
    return Border{step.offset, step.face};
  };
  return bordersOf([&] { return find(profile.whole()); }, [&](int half) { return find(profile.half(half)); });
}

Borders findDepthBorders(const DepthEdge& edge) {
  const auto border = [](const std::optional<DepthEdge::Place>& place) {
    return place ? std::optional<Border>(Border{place->offset, place->face}) : std::nullopt;
  };
  return bordersOf([&] { return border(edge.whole()); }, [&](int half) { return border(edge.half(half)); });
}

Borders findCreases(const EdgeProfile& on_plane, const EdgeProfile& on_neighbour, const Neighbour& neighbour) {
  const auto find = [&](const EdgeProfile::Residuals& plane, const EdgeProfile::Residuals& other) -> std::optional<Border> {
    const auto crease = findCrease(plane, other, neighbour);
    if (!crease) return std::nullopt;
    return Border{crease->offset, false, crease->nearer};
  };
  return bordersOf([&] { return find(on_plane.whole(), on_neighbour.whole()); },
                   [&](int half) { return find(on_plane.half(half), on_neighbour.half(half)); });
}

/// [m] how far an edge may go on behind the neighbour at a crease.
double hiddenBehind(const StereoCamera& camera, double disparity, double nearer, double angle) {
  const double step = camera.focalBaseline() / disparity - camera.focalBaseline() / (disparity + nearer);
  return step < kBoard ? kBoard * std::tan(angle / 2) : std::numeric_limits<double>::infinity();
}

/// The same by depth, where `image` was moved by `start` [px]. The edge lies behind the neighbour by up to the board's thickness,
/// half of it in the mean. Planes alone say too little: their errors move the line where they meet by centimetres.
std::optional<EdgeShift> depthCrease(const DepthFrame& frame, const PlaneRegion& region, const ImageEdge& image,
                                     const Neighbour& neighbour, double start) {
  const std::optional<double> place = DepthEdge(frame, region, image, {}).crease(neighbour.slope);
  if (!place) return std::nullopt;
  const double tangent = std::tan(neighbour.angle / 2);
  EdgeShift shift;
  shift.distance = (start + *place) * image.metres_per_pixel + kBoard / 2 * (1 + tangent);
  shift.border = Border{shift.distance / image.metres_per_pixel};
  shift.hidden = kBoard * tangent;
  return shift;
}

/// A hinge lies within the thickness of its door. The door turned by an angle, its edge lies up to 1 + tan(angle / 2) of that
/// beyond the line where both planes meet. It is seen as far as what lies beyond tan(angle / 2) of it. Masks may end elsewhere:
/// block matching cannot tell the planes apart there.
std::optional<EdgeShift> measureCrease(const PlaneChart& chart, const PlaneRegion& region, const Surroundings& surroundings,
                                       const PlaneRectangle& rectangle, Edge edge) {
  std::optional<ImageEdge> image = imageEdge(chart, rectangle, edge);
  std::optional<Neighbour> neighbour = neighbourBeyond(*image, region, surroundings.regions);
  if (!neighbour) return std::nullopt;
  const double least = -neighbour->at_edge / neighbour->slope;
  const double most = least + kBoard * (1 + std::tan(neighbour->angle / 2)) / image->metres_per_pixel;
  const double start = std::clamp(0.0, least, most);
  PlaneRectangle moved = rectangle;
  moved.moveEdge(edge, start * image->metres_per_pixel);
  if (moved.side(edgeAxis(edge)) < rectangle.side(edgeAxis(edge)) / 2) return std::nullopt;
  image = imageEdge(chart, moved, edge);
  if (!image) return std::nullopt;
  neighbour->at_edge = neighbour->at(start);
  if (!hasImages(surroundings.frame)) return depthCrease(surroundings.frame, region, *image, *neighbour, start);
  PlaneRegion other;  // what a profile looks at
  other.mask = region.mask;
  other.disparity_plane = neighbour->plane;
  const Borders borders =
      findCreases(EdgeProfile(surroundings.frame, region, *image), EdgeProfile(surroundings.frame, other, *image), *neighbour);
  EdgeShift shift = shiftTo(borders, *image, rectangle.side(1 - edgeAxis(edge)));
  const double place = start + shift.distance / image->metres_per_pixel;
  if (!shift.border || place > most + kTolerance) return EdgeShift{{}, start * image->metres_per_pixel, {}, 0, 0};
  shift.distance = place * image->metres_per_pixel;
  const Eigen::Vector2d middle = (image->a + image->b) / 2;
  const double disparity = region.disparity_plane.at(middle.x(), middle.y());
  shift.hidden = hiddenBehind(surroundings.frame.camera, disparity, shift.border->nearer, neighbour->angle);
  return shift;
}

EdgeShift measure(const PlaneChart& chart, const PlaneRegion& region, const Surroundings& surroundings,
                  const PlaneRectangle& rectangle, Edge edge, const RectanglesConfig& config) {
  const std::optional<ImageEdge> image = imageEdge(chart, rectangle, edge);
  if (!image) return {};
  const double length = rectangle.side(1 - edgeAxis(edge));
  const std::optional<EdgeShift> crease = measureCrease(chart, region, surroundings, rectangle, edge);
  if (crease && crease->border) return *crease;
  const SideFace face = sideFace(chart, surroundings.frame.camera, region.disparity_plane, rectangle, edge);
  if (!hasImages(surroundings.frame))
    return shiftTo(findDepthBorders(DepthEdge(surroundings.frame, region, *image, face)), *image, length);
  const EdgeProfile profile(surroundings.frame, region, *image);
  const EdgeShift shift = shiftTo(findBorders(profile, face, config), *image, length);
  return shift.border || !crease ? shift : *crease;
}

}  // namespace

RefinedRectangle refineEdges(const PlaneChart& chart, const PlaneRegion& region, const Surroundings& surroundings,
                             const PlaneRectangle& rectangle, const RectanglesConfig& config) {
  RefinedRectangle result;
  result.rectangle = rectangle;
  for (int pass = 0; pass < kPasses; ++pass) {
    const PlaneRectangle start = result.rectangle;
    double turn = 0, weight = 1 / (kMaskTurnSigma * kMaskTurnSigma), moved = 0;
    for (const Edge edge : kEdges) {
      const EdgeShift shift = measure(chart, region, surroundings, start, edge, config);
      result.placed[edge] = shift.border.has_value();
      result.confirmed[edge] = hasImages(surroundings.frame) && result.placed[edge];
      result.hidden[edge] = shift.hidden;
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
