// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/rectangle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// A convex polygon. Each of the four cuts of a quadrilateral adds a corner at most.
class Polygon {
 public:
  size_t size() const { return size_; }
  const Eigen::Vector2d& operator[](size_t i) const { return corners_[i]; }
  void push_back(const Eigen::Vector2d& corner) {
    if (size_ < corners_.size()) corners_[size_++] = corner;
  }

 private:
  std::array<Eigen::Vector2d, 8> corners_;
  size_t size_ = 0;
};

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double signedArea(const Polygon& polygon) {
  double twice = 0;
  for (size_t i = 0; i < polygon.size(); ++i) twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return twice / 2;
}

/// Sutherland-Hodgman: the part of a polygon where normal . p <= limit.
Polygon clip(const Polygon& polygon, const Eigen::Vector2d& normal, double limit) {
  Polygon kept;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d& p = polygon[i];
    const Eigen::Vector2d& next = polygon[(i + 1) % polygon.size()];
    const double excess = normal.dot(p) - limit;
    const double excess_next = normal.dot(next) - limit;
    if (excess <= 0) kept.push_back(p);
    if ((excess < 0 && excess_next > 0) || (excess > 0 && excess_next < 0))
      kept.push_back(p + (next - p) * (excess / (excess - excess_next)));
  }
  return kept;
}

}  // namespace

std::array<Eigen::Vector3d, 4> Rectangle::corners() const {
  const double x = width / 2;
  const double y = height / 2;
  return {pose * Eigen::Vector3d(-x, -y, 0), pose * Eigen::Vector3d(x, -y, 0), pose * Eigen::Vector3d(x, y, 0),
          pose * Eigen::Vector3d(-x, y, 0)};
}

Rectangle describe(const Rectangle& rectangle, int k) {
  Rectangle result = rectangle;
  if (k >= 4) result.pose.linear() *= Eigen::Vector3d(1, -1, -1).asDiagonal();
  // Quarter turns without trigonometry, so that four of them give back exactly the same numbers.
  for (int turn = 0; turn < k % 4; ++turn) {
    Eigen::Matrix3d turned = result.pose.linear();
    turned.col(0) = result.pose.linear().col(1);
    turned.col(1) = -result.pose.linear().col(0);
    result.pose.linear() = turned;
    std::swap(result.width, result.height);
  }
  return result;
}

double angleBetween(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Quaterniond difference(a.linear().transpose() * b.linear());
  return 2 * std::atan2(difference.vec().norm(), std::abs(difference.w()));
}

Rectangle alignDescription(const Rectangle& rectangle, const Rectangle& reference, bool allow_back) {
  Rectangle best = rectangle;
  double best_angle = angleBetween(best.pose, reference.pose);
  for (int k = 1; k < (allow_back ? kDescriptions : kDescriptions / 2); ++k) {
    const Rectangle candidate = describe(rectangle, k);
    const double angle = angleBetween(candidate.pose, reference.pose);
    if (angle < best_angle) {
      best = candidate;
      best_angle = angle;
    }
  }
  return best;
}

double intersectionOverUnion(const Rectangle& reference, const Rectangle& other) {
  const Eigen::Isometry3d to_reference = reference.pose.inverse();
  Polygon polygon;
  for (const Eigen::Vector3d& corner : other.corners()) polygon.push_back((to_reference * corner).head<2>());
  const double other_area = std::abs(signedArea(polygon));
  for (int axis = 0; axis < 2; ++axis) {
    const double half = (axis == 0 ? reference.width : reference.height) / 2;
    polygon = clip(polygon, Eigen::Vector2d::Unit(axis), half);
    polygon = clip(polygon, -Eigen::Vector2d::Unit(axis), half);
  }
  const double intersection = std::abs(signedArea(polygon));
  const double total = reference.width * reference.height + other_area - intersection;
  return total > 0 ? intersection / total : 0;
}

}  // namespace cabinet_articulation::core
