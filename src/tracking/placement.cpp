// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cabinet_articulation::core {
namespace {

constexpr double kAgreement = 0.025;   ///< [m] two observed edges may miss the front's length by this much (twice 90 % of edges)
constexpr double kUnseenSlack = 0.05;  ///< [m] a front without any observed edge along an axis may slide this far unnoticed
constexpr double kEdgeSigma = 0.005;   ///< [m] of one observed edge

struct Length {
  double value;
  double sigma;
};

/// Along one axis: how far the centre has to be shifted, the length there, and the variance of the centre [m, m, m^2].
struct Extent {
  double shift;
  double length;
  double variance;
};

/// `expected` is the shift that would mean no motion.
Extent placeAlong(double measured, const Length& known, std::pair<float, float> support, double expected, double variance,
                  double min_support) {
  const bool minus_seen = support.first >= min_support;
  const bool plus_seen = support.second >= min_support;
  const double excess = measured - known.value;
  if (minus_seen != plus_seen)
    return {plus_seen ? excess / 2 : -excess / 2, known.value, kEdgeSigma * kEdgeSigma + known.sigma * known.sigma / 4};
  if (minus_seen && std::abs(excess) <= kAgreement) return {0, measured, variance};
  const double slack = minus_seen ? std::abs(excess) / 2 : std::max(std::abs(excess) / 2, kUnseenSlack);
  return {std::clamp(expected, -slack, slack), known.value, std::max(variance, slack * slack / 3)};
}

}  // namespace

DetectedRectangle describe(const DetectedRectangle& detection, int k) {
  DetectedRectangle result = detection;
  result.rectangle = describe(detection.rectangle, k);
  auto& support = result.edge_support;
  if (k >= 4) std::swap(support[kEdgeMinusY], support[kEdgePlusY]);
  for (int turn = 0; turn < k % 4; ++turn)
    support = {support[kEdgeMinusY], support[kEdgePlusY], support[kEdgePlusX], support[kEdgeMinusX]};
  return result;
}

DetectedRectangle placeOnObservedEdges(const DetectedRectangle& detection, const KnownSize& size, const Rectangle* expected,
                                       double min_support) {
  DetectedRectangle placed = detection;
  const Eigen::Matrix3d& axes = detection.rectangle.pose.linear();
  const Eigen::Vector2d measured(detection.rectangle.width, detection.rectangle.height);
  Eigen::Vector3d unmoved = Eigen::Vector3d::Zero();
  if (expected) unmoved = axes.transpose() * (expected->center() - detection.rectangle.center());
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = axes.transpose() * detection.covariance.topLeftCorner<3, 3>() * axes;
  Eigen::Vector2d length;
  for (int axis = 0; axis < 2; ++axis) {
    const auto support = std::make_pair(detection.edge_support[2 * axis], detection.edge_support[2 * axis + 1]);
    const Extent extent = placeAlong(measured[axis], {size.value[axis], size.sigma[axis]}, support, unmoved[axis],
                                     covariance(axis, axis), min_support);
    shift[axis] = extent.shift;
    length[axis] = extent.length;
    if (extent.variance == covariance(axis, axis)) continue;
    covariance.row(axis).setZero();
    covariance.col(axis).setZero();
    covariance(axis, axis) = extent.variance;
  }
  placed.rectangle.pose.translation() += axes * shift;
  placed.rectangle.width = length.x();
  placed.rectangle.height = length.y();
  placed.covariance.topLeftCorner<3, 3>() = axes * covariance * axes.transpose();
  return placed;
}

}  // namespace cabinet_articulation::core
