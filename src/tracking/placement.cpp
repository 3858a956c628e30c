// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/placement.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cabinet_articulation::core {
namespace {

constexpr double kAgreement = 0.015;   ///< [m] two observed edges may miss the front's size by this much (90 % of edges: 12 mm)
constexpr double kUnseenSlack = 0.05;  ///< [m] a front without any observed edge along an axis may slide this far unnoticed
constexpr double kEdgeSigma = 0.005;   ///< [m] of one observed edge

/// Along one axis: how far the centre has to be shifted, and the variance of the result [m, m^2].
struct Shift {
  double value;
  double variance;
};

/// `excess` is how much longer the front appears than it is; `expected` the shift that would mean no motion.
Shift placeAlong(double excess, std::pair<float, float> support, double expected, double variance, double min_support) {
  const bool minus_seen = support.first >= min_support;
  const bool plus_seen = support.second >= min_support;
  if (minus_seen != plus_seen) return {plus_seen ? excess / 2 : -excess / 2, kEdgeSigma * kEdgeSigma};
  if (minus_seen && std::abs(excess) <= kAgreement)
    return {excess / 2 * (support.second - support.first) / std::max(support.second + support.first, 1e-3F), variance};
  const double slack = minus_seen ? std::abs(excess) / 2 : std::max(std::abs(excess) / 2, kUnseenSlack);
  return {std::clamp(expected, -slack, slack), std::max(variance, slack * slack / 3)};
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

DetectedRectangle alignDescription(const DetectedRectangle& detection, const Rectangle& reference) {
  int best = 0;
  double best_angle = angleBetween(detection.rectangle.pose, reference.pose);
  for (int k = 1; k < kDescriptions; ++k) {
    const double angle = angleBetween(describe(detection.rectangle, k).pose, reference.pose);
    if (angle >= best_angle) continue;
    best = k;
    best_angle = angle;
  }
  return describe(detection, best);
}

DetectedRectangle placeOnObservedEdges(const DetectedRectangle& detection, const Eigen::Vector2d& size, const Rectangle* expected,
                                       double min_support) {
  DetectedRectangle placed = detection;
  const Eigen::Matrix3d& axes = detection.rectangle.pose.linear();
  const Eigen::Vector2d measured(detection.rectangle.width, detection.rectangle.height);
  Eigen::Vector3d unmoved = Eigen::Vector3d::Zero();
  if (expected) unmoved = axes.transpose() * (expected->center() - detection.rectangle.center());
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance = axes.transpose() * detection.covariance.topLeftCorner<3, 3>() * axes;
  for (int axis = 0; axis < 2; ++axis) {
    const auto support = std::make_pair(detection.edge_support[2 * axis], detection.edge_support[2 * axis + 1]);
    const Shift along = placeAlong(measured[axis] - size[axis], support, unmoved[axis], covariance(axis, axis), min_support);
    shift[axis] = along.value;
    if (along.variance == covariance(axis, axis)) continue;
    covariance.row(axis).setZero();
    covariance.col(axis).setZero();
    covariance(axis, axis) = along.variance;
  }
  placed.rectangle.pose.translation() += axes * shift;
  placed.rectangle.width = size.x();
  placed.rectangle.height = size.y();
  placed.covariance.topLeftCorner<3, 3>() = axes * covariance * axes.transpose();
  return placed;
}

}  // namespace cabinet_articulation::core
