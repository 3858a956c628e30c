// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/crease.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace cabinet_articulation::core {
namespace {

constexpr int kSamples = 16;                      ///< along the edge
constexpr double kDistances[] = {6, 10, 14, 18};  ///< [px] outward; block matching blurs what lies nearer
constexpr double kLeastShare = 0.5;               ///< of the samples that a neighbour has
constexpr double kLeastAngle = 0.12;              ///< [rad] planes that differ less may be two fits of one surface
constexpr double kFarthest = 40;                  ///< [px] that a mask may reach over the line where two planes meet
constexpr double kNearest = 8;                    ///< [px] that it may end before it
constexpr float kEvidenceInside = 1;              ///< sum of log residuals that the neighbour alone must explain worse
constexpr float kEvidenceOutside = 2;             ///< and that the rectangle's plane alone must
constexpr float kSmallestResidual = 0.005F;       ///< of a plane refined on the images itself

float logResidual(const EdgeProfile::Residuals& residuals, int strip) {
  return std::log(std::max(residuals.residual[strip][EdgeProfile::kOnPlane], kSmallestResidual));
}

/// How another region's plane lies to this one's at an edge. Nothing for planes that do not meet near it.
std::optional<Neighbour> meeting(const ImageEdge& edge, const PlaneRegion& region, const PlaneRegion& other) {
  const auto difference = [&](const Eigen::Vector2d& pixel) {
    return other.disparity_plane.at(pixel.x(), pixel.y()) - region.disparity_plane.at(pixel.x(), pixel.y());
  };
  const Eigen::Vector2d middle = (edge.a + edge.b) / 2;
  Neighbour neighbour;
  neighbour.at_edge = difference(middle);
  neighbour.slope = difference(middle + edge.outward) - neighbour.at_edge;
  neighbour.plane = other.disparity_plane;
  const bool near = neighbour.slope > 0 && neighbour.at(-kFarthest) < 0 && neighbour.at(kNearest) > 0;
  if (!near) return std::nullopt;
  neighbour.angle = std::acos(std::clamp(other.plane.normal.dot(region.plane.normal), -1.0, 1.0));
  return neighbour.angle < kLeastAngle ? std::nullopt : std::optional<Neighbour>(neighbour);
}

/// Some pixels beyond an edge.
class PlacesBeyond {
 public:
  PlacesBeyond(const ImageEdge& edge, const cv::Size& image) {
    for (int i = 0; i < kSamples; ++i)
      for (const double distance : kDistances) {
        const Eigen::Vector2d pixel = edge.at((i + 0.5) / kSamples, distance);
        const cv::Point nearest(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
        if (cv::Rect({0, 0}, image).contains(nearest)) places_[n_++] = nearest;
      }
  }

  /// How many of them belong to a region.
  int count(const PlaneRegion& region) const {
    return static_cast<int>(
        std::count_if(places_.begin(), places_.begin() + n_, [&](const cv::Point& p) { return region.mask(p) == kInPlane; }));
  }

 private:
  std::array<cv::Point, kSamples * std::size(kDistances)> places_;
  int n_ = 0;
};

}  // namespace

std::optional<Neighbour> neighbourBeyond(const ImageEdge& edge, const PlaneRegion& region,
                                         const std::vector<PlaneRegion>& regions) {
  std::optional<Neighbour> neighbour;
  std::optional<PlacesBeyond> places;
  int most = static_cast<int>(kLeastShare * kSamples * std::size(kDistances));
  for (const PlaneRegion& other : regions) {
    if (other.mask.data == region.mask.data) continue;
    const std::optional<Neighbour> candidate = meeting(edge, region, other);
    if (!candidate) continue;
    if (!places) places.emplace(edge, region.mask.size());
    const int count = places->count(other);
    if (count <= most) continue;
    most = count;
    neighbour = candidate;
  }
  return neighbour;
}

std::optional<Crease> findCrease(const EdgeProfile::Residuals& on_plane, const EdgeProfile::Residuals& on_neighbour,
                                 const Neighbour& neighbour) {
  float sum = 0, least = 0;  // of how much worse the rectangle's plane explains the strips
  int begin = 0;
  for (int k = 0; k < EdgeProfile::kStrips; ++k) {
    sum += on_plane.weight[k] * (logResidual(on_plane, k) - logResidual(on_neighbour, k));
    if (sum >= least) continue;
    least = sum;
    begin = k + 1;
  }
  const Crease crease{EdgeProfile::offset(begin), neighbour.at(EdgeProfile::offset(begin))};
  if (-least < kEvidenceInside || sum - least < kEvidenceOutside || crease.nearer < 0) return std::nullopt;
  return crease;
}

}  // namespace cabinet_articulation::core
