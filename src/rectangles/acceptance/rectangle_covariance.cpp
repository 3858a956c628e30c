// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/acceptance/rectangle_covariance.h"

#include <Eigen/LU>
#include <algorithm>

#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kConfirmedSigma = 0.4;     ///< [px] of an edge that the images place
constexpr double kMaskSigma = 2.0;          ///< [px] of an edge of a 15x15 block matching mask
constexpr double kDoubtful = 0.25;          ///< support of an edge that nothing but a neighbour in nearly the same plane ends
constexpr double kUnobservedSigma = 0.3;    ///< [m] of an edge that was not seen: the size of a front
constexpr double kUnobservedAngle = 0.3;    ///< [rad] without any edge
constexpr double kDisparitySigma = 0.15;    ///< [px] of a block matching disparity
constexpr double kRefinedSigma = 0.05;      ///< [px] of a plane refined on the images, per independent pixel
constexpr double kIndependentPixels = 225;  ///< pixels that share one error: a 15x15 window
constexpr double kMostRefined = 60;         ///< windows beyond which errors common to all pixels (interpolation, warp) remain
constexpr int kGrid = 8;                    ///< samples of the in-plane pixels along each side
constexpr double kPriorTilt = 0.5;          ///< [rad] of a plane that hardly any pixel supports
constexpr double kPriorDepth = 0.1;         ///< [m]

struct InPlane {
  Eigen::Vector2d variance;  ///< [m^2] of the centre along the rectangle's x and y
  double angle_variance;     ///< [rad^2] about the normal
};

InPlane fromEdges(const PlaneChart& chart, const PlaneRectangle& rectangle, const std::array<EdgeObservation, 4>& edges) {
  InPlane result{Eigen::Vector2d::Zero(), 0};
  double angle_information = 1 / (kUnobservedAngle * kUnobservedAngle);
  for (const Edge edge : kEdges) {
    double information = 1 / (kUnobservedSigma * kUnobservedSigma);
    if (const std::optional<ImageEdge> image = imageEdge(chart, rectangle, edge)) {
      const double sigma = (edges[edge].confirmed ? kConfirmedSigma : kMaskSigma) * image->metres_per_pixel;
      const double seen = std::max(edges[edge].support - kDoubtful, 0.0) / (1 - kDoubtful);
      const double observed = seen / (sigma * sigma);
      const double length = rectangle.side(1 - edgeAxis(edge));
      information += observed;
      angle_information += observed * length * length / 12;  // variance of places spread evenly over a length
    }
    result.variance[edgeAxis(edge)] += 1 / information / 4;  // the centre is the mean of two edges
  }
  result.angle_variance = 1 / angle_information;
  return result;
}

/// Covariance of (shift along the normal at the centre, turn about x, turn about y).
Eigen::Matrix3d fromPlane(const PlaneChart& chart, const PlaneRectangle& rectangle, const PlaneRegion& region,
                          const DepthFrame& frame) {
  const Rectangle space = chart.toSpace(rectangle);
  Eigen::Matrix3d information =
      Eigen::Vector3d(1 / (kPriorDepth * kPriorDepth), 1 / (kPriorTilt * kPriorTilt), 1 / (kPriorTilt * kPriorTilt)).asDiagonal();
  Eigen::Matrix3d observed = Eigen::Matrix3d::Zero();
  int samples = 0;
  for (int i = 0; i < kGrid * kGrid; ++i) {
    const double x = ((i % kGrid + 0.5) / kGrid - 0.5) * rectangle.width;
    const double y = ((i / kGrid + 0.5) / kGrid - 0.5) * rectangle.height;
    const Eigen::Vector3d p = space.pose * Eigen::Vector3d(x, y, 0);
    if (!(p.z() > 0)) continue;
    const Eigen::Vector2d pixel = frame.camera.project(p);
    const int u = static_cast<int>(std::lround(pixel.x()));
    const int v = static_cast<int>(std::lround(pixel.y()));
    if (u < 0 || v < 0 || u >= region.mask.cols || v >= region.mask.rows || region.mask(v, u) != kInPlane) continue;
    // A shift along the normal by one metre changes this pixel's depth by 1 / (n.r), its disparity by -f B / z^2 of that.
    const double approach = space.normal().dot(p) / p.z();
    const double per_metre = -frame.camera.focalBaseline() / (p.z() * p.z() * approach);
    const Eigen::Vector3d jacobian = per_metre * Eigen::Vector3d(1, y, -x);
    observed += jacobian * jacobian.transpose();
    ++samples;
  }
  if (samples > 0) {
    const bool refined = hasImages(frame);
    const double sigma = refined ? kRefinedSigma : kDisparitySigma;
    const double windows = std::max(region.inliers / kIndependentPixels, 1.0);
    const double independent = refined ? std::min(windows, kMostRefined) : windows;
    information += observed * (independent / (samples * sigma * sigma));
  }
  return information.inverse();
}

}  // namespace

Matrix6d rectangleCovariance(const PlaneChart& chart, const PlaneRectangle& rectangle,
                             const std::array<EdgeObservation, 4>& edges, const PlaneRegion& region, const DepthFrame& frame) {
  const Rectangle space = chart.toSpace(rectangle);
  const InPlane in_plane = fromEdges(chart, rectangle, edges);
  Matrix6d local = Matrix6d::Zero();  // in the rectangle's own axes
  local(0, 0) = in_plane.variance.x();
  local(1, 1) = in_plane.variance.y();
  local(5, 5) = in_plane.angle_variance;
  // Edges are seen as fixed lines of sight: a shift t along the normal carries the centre by t * sight / (n.sight).
  const Eigen::Vector3d sight = space.pose.linear().transpose() * space.center();
  Eigen::Matrix<double, 6, 3> from_plane = Eigen::Matrix<double, 6, 3>::Zero();
  from_plane.topLeftCorner<3, 1>() = sight / sight.z();
  from_plane(3, 1) = 1;
  from_plane(4, 2) = 1;
  local += from_plane * fromPlane(chart, rectangle, region, frame) * from_plane.transpose();
  Matrix6d rotation = Matrix6d::Zero();
  rotation.topLeftCorner<3, 3>() = space.pose.linear();
  rotation.bottomRightCorner<3, 3>() = space.pose.linear();
  return rotation * local * rotation.transpose();
}

}  // namespace cabinet_articulation::core
