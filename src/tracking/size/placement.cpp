// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/size/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cabinet_articulation::core {
namespace {

constexpr double kWellSeen = 0.8;       ///< share of an edge beyond which more of it places it no better
constexpr double kContradiction = 3.0;  ///< standard deviations of an axis' length; beyond, one of its edges is wrong

/// Along one axis: how far the centre has to be shifted, the length there, and the variance of the centre [m, m, m^2].
struct Extent {
  double shift;
  double length;
  double variance;
};

/// Two edges and the known length between them, by least squares. `excess` is the measured length beyond the known one.
Extent placeAlong(double excess, double known, double known_sigma, Eigen::Vector2d edge_variances) {
  const double prior = known_sigma * known_sigma;
  const double contradiction = excess * excess - kContradiction * kContradiction * (edge_variances.sum() + prior);
  if (contradiction > 0) edge_variances *= 1 + contradiction / edge_variances.sum();
  const double edges = edge_variances.sum();
  const double total = edges + prior;
  const double imbalance = edge_variances[0] - edge_variances[1];
  return {imbalance / (2 * total) * excess, known + prior / total * excess, edges / 4 - imbalance * imbalance / (4 * total)};
}

/// The same, and the centre expected at `shift`.
Extent heldBack(Extent extent, double shift, double variance) {
  const double gain = extent.variance / (extent.variance + variance);
  extent.shift += gain * (shift - extent.shift);
  extent.variance *= 1 - gain;
  return extent;
}

/// Along x and along y of the detection.
std::array<Extent, 2> placeAlongAxes(const DetectedRectangle& detection, const KnownSize& size, const KnownPlace* expected,
                                     const TrackingConfig& config) {
  const Rectangle& rectangle = detection.rectangle;
  const double measured[] = {rectangle.width, rectangle.height};
  std::array<Extent, 2> extents;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d sigmas(edgeSigma(detection.edge_support[2 * axis], config),
                                 edgeSigma(detection.edge_support[2 * axis + 1], config));
    const double known = size.value[axis];
    extents[axis] = placeAlong(measured[axis] - known, known, size.sigma[axis], sigmas.cwiseAbs2());
    if (!expected) continue;
    const Eigen::Vector3d direction = rectangle.pose.linear().col(axis);
    const double motion = direction.dot(expected->rectangle.center() - rectangle.center());
    const double variance = std::pow(config.position_tolerance, 2) + direction.dot(expected->covariance * direction);
    extents[axis] = heldBack(extents[axis], motion, variance);
  }
  return extents;
}

Rectangle shifted(Rectangle rectangle, const std::array<Extent, 2>& extents) {
  rectangle.pose.translate(Eigen::Vector3d(extents[0].shift, extents[1].shift, 0));
  rectangle.width = extents[0].length;
  rectangle.height = extents[1].length;
  return rectangle;
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

double edgeSigma(double support, const TrackingConfig& config) {
  const double unseen = std::clamp(1 - support / kWellSeen, 0.0, 1.0);
  return config.edge_sigma * std::pow(config.unseen_edge_sigma / config.edge_sigma, unseen);
}

Rectangle placeRectangle(const DetectedRectangle& detection, const KnownSize& size, const KnownPlace* expected,
                         const TrackingConfig& config) {
  return shifted(detection.rectangle, placeAlongAxes(detection, size, expected, config));
}

DetectedRectangle placeOnObservedEdges(const DetectedRectangle& detection, const KnownSize& size, const KnownPlace* expected,
                                       const TrackingConfig& config) {
  const std::array<Extent, 2> extents = placeAlongAxes(detection, size, expected, config);
  Matrix6d axes = Matrix6d::Zero();
  axes.topLeftCorner<3, 3>() = axes.bottomRightCorner<3, 3>() = detection.rectangle.pose.linear();
  Matrix6d covariance = axes.transpose() * detection.covariance * axes;
  for (int axis = 0; axis < 2; ++axis) {
    covariance.row(axis).setZero();
    covariance.col(axis).setZero();
    covariance(axis, axis) = extents[axis].variance;
  }
  DetectedRectangle placed = detection;
  placed.rectangle = shifted(detection.rectangle, extents);
  placed.covariance = axes * covariance * axes.transpose();
  return placed;
}

}  // namespace cabinet_articulation::core
