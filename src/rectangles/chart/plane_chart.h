// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "cabinet_articulation/geometry/plane.h"
#include "cabinet_articulation/geometry/rectangle.h"

namespace cabinet_articulation::core {

/// A rectangle in the coordinates of a PlaneChart: the five degrees of freedom that are left once the plane is known.
struct PlaneRectangle {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();  ///< [m]
  double angle = 0;                                  ///< [rad] of the width's direction
  double width = 0;                                  ///< [m]
  double height = 0;                                 ///< [m]

  Eigen::Vector2d xAxis() const { return {std::cos(angle), std::sin(angle)}; }
  Eigen::Vector2d yAxis() const { return {-std::sin(angle), std::cos(angle)}; }
  double side(int axis) const { return axis == 0 ? width : height; }

  /// The outward normal of an edge.
  Eigen::Vector2d outward(Edge edge) const;

  /// Moves one edge outward by `distance` [m]; the opposite edge stays.
  void moveEdge(Edge edge, double distance);

  /// In the order of Rectangle::corners().
  std::array<Eigen::Vector2d, 4> corners() const;
};

/// The corners of a rectangle in the image, in the order of Rectangle::corners(); convex.
using ImageQuad = std::array<Eigen::Vector2d, 4>;

/// Metric coordinates within a plane (ours): x follows the image's x axis, z is the plane's normal.
class PlaneChart {
 public:
  /// The chart's origin is where the ray of `pixel` meets the plane. Nothing if it does not.
  static std::optional<PlaneChart> at(const Plane& plane, const StereoCamera& camera, const Eigen::Vector2d& pixel);

  /// Nothing for a pixel that does not see the plane.
  std::optional<Eigen::Vector2d> fromPixel(const Eigen::Vector2d& pixel) const;

  /// [px]; only for points in front of the camera.
  Eigen::Vector2d toPixel(const Eigen::Vector2d& point) const { return (H_image_chart_ * point.homogeneous()).hnormalized(); }

  /// Nothing if a corner lies behind the camera.
  std::optional<ImageQuad> project(const PlaneRectangle& rectangle) const;

  /// In the left optical frame.
  Rectangle toSpace(const PlaneRectangle& rectangle) const;

  /// The rectangle's centre and x axis dropped onto the plane, its size kept.
  PlaneRectangle fromSpace(const Rectangle& rectangle) const;

  /// At the chart's origin, across the line of sight.
  double pixelsPerMetre() const { return pixels_per_metre_; }

  const Eigen::Isometry3d& pose() const { return T_camera_chart_; }

 private:
  Eigen::Isometry3d T_camera_chart_ = Eigen::Isometry3d::Identity();
  Eigen::Matrix3d H_image_chart_ = Eigen::Matrix3d::Identity();  ///< chart [m] -> left image [px]; third row is the depth [m]
  Eigen::Matrix3d H_chart_image_ = Eigen::Matrix3d::Identity();
  double pixels_per_metre_ = 0;
};

}  // namespace cabinet_articulation::core
