// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/chart/plane_chart.h"

#include <cmath>

namespace cabinet_articulation::core {
namespace {
constexpr double kNearest = 0.01;  ///< [m] corners closer to the camera's centre plane have no useful image
}

Eigen::Vector2d PlaneRectangle::outward(Edge edge) const {
  const Eigen::Vector2d axis = edge == kEdgeMinusX || edge == kEdgePlusX ? xAxis() : yAxis();
  return edge == kEdgePlusX || edge == kEdgePlusY ? axis : Eigen::Vector2d(-axis);
}

void PlaneRectangle::moveEdge(Edge edge, double distance) {
  center += outward(edge) * (distance / 2);
  (edge == kEdgeMinusX || edge == kEdgePlusX ? width : height) += distance;
}

std::array<Eigen::Vector2d, 4> PlaneRectangle::corners() const {
  const Eigen::Vector2d x = xAxis() * (width / 2);
  const Eigen::Vector2d y = yAxis() * (height / 2);
  return {center - x - y, center + x - y, center + x + y, center - x + y};
}

std::optional<PlaneChart> PlaneChart::at(const Plane& plane, const StereoCamera& camera, const Eigen::Vector2d& pixel) {
  const std::optional<Eigen::Vector3d> origin = plane.intersect(camera.ray(pixel.x(), pixel.y()));
  if (!origin) return std::nullopt;
  PlaneChart chart;
  const Eigen::Vector3d z = plane.normal;
  // A plane seen edge-on from the side has its normal along the image's x axis; then y leads.
  const Eigen::Vector3d hint = std::abs(z.x()) < 0.99 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d x = (hint - z * z.dot(hint)).normalized();
  chart.T_camera_chart_.linear() << x, z.cross(x), z;
  chart.T_camera_chart_.translation() = *origin;
  Eigen::Matrix3d K;
  K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
  Eigen::Matrix3d axes;
  axes << x, z.cross(x), *origin;
  chart.H_image_chart_ = K * axes;
  chart.pixels_per_metre_ = camera.fx / origin->z();
  chart.H_chart_image_ = chart.H_image_chart_.inverse();
  return chart;
}

std::optional<Eigen::Vector2d> PlaneChart::fromPixel(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector3d p = H_chart_image_ * pixel.homogeneous();
  if (!(p.z() > 0)) return std::nullopt;  // p.z is 1 / depth
  return Eigen::Vector2d(p.hnormalized());
}

std::optional<ImageQuad> PlaneChart::project(const PlaneRectangle& rectangle) const {
  ImageQuad quad;
  const std::array<Eigen::Vector2d, 4> corners = rectangle.corners();
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = H_image_chart_ * corners[i].homogeneous();
    if (!(p.z() > kNearest)) return std::nullopt;
    quad[i] = p.hnormalized();
  }
  return quad;
}

Rectangle PlaneChart::toSpace(const PlaneRectangle& rectangle) const {
  Rectangle result;
  Eigen::Isometry3d T_chart_rectangle = Eigen::Isometry3d::Identity();
  T_chart_rectangle.linear() = Eigen::AngleAxisd(rectangle.angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  T_chart_rectangle.translation().head<2>() = rectangle.center;
  result.pose = T_camera_chart_ * T_chart_rectangle;
  result.width = rectangle.width;
  result.height = rectangle.height;
  return result;
}

PlaneRectangle PlaneChart::fromSpace(const Rectangle& rectangle) const {
  const Eigen::Isometry3d T_chart_rectangle = T_camera_chart_.inverse() * rectangle.pose;
  PlaneRectangle result;
  result.center = T_chart_rectangle.translation().head<2>();
  result.angle = std::atan2(T_chart_rectangle.linear()(1, 0), T_chart_rectangle.linear()(0, 0));
  result.width = rectangle.width;
  result.height = rectangle.height;
  return result;
}

}  // namespace cabinet_articulation::core
