// SPDX-License-Identifier: BSD-3-Clause
#include "scores/detection_score.h"

#include <algorithm>
#include <cmath>

#include "geometry/degrees.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kMinOpened = 0.03, kMinVisible = 0.5, kMinInImage = 0.98;
constexpr double kMinIou = 0.8, kMaxOffset = 0.03, kMaxNormal = 6 * kDegree;

}  // namespace

bool canBeDetected(const Front& front) {
  return front.opened >= kMinOpened && front.visible >= kMinVisible && front.in_image >= kMinInImage && front.faces_camera;
}

DetectionScore scoreDetection(const Rectangle& truth, const std::vector<DetectedRectangle>& rectangles) {
  DetectionScore score;
  for (std::size_t i = 0; i < rectangles.size(); ++i) {
    const double iou = intersectionOverUnion(truth, rectangles[i].rectangle);
    if (iou <= score.iou) continue;
    score.iou = iou;
    score.best = static_cast<int>(i);
  }
  if (score.best < 0) return score;
  // The description nearest to the truth removes the ambiguity of 90 and 180 degrees.
  const Rectangle best = alignDescription(rectangles[score.best].rectangle, truth, true);
  const Eigen::Vector3d shift = best.center() - truth.center();
  const Eigen::Vector3d x_in_truth = truth.pose.linear().transpose() * best.pose.linear().col(0);
  score.center = shift.norm();
  score.offset = std::abs(truth.normal().dot(shift));
  score.normal = std::acos(std::min(1.0, std::abs(truth.normal().dot(best.normal()))));
  score.in_plane = std::abs(std::atan2(x_in_truth.y(), x_in_truth.x()));
  score.orientation = angleBetween(truth.pose, best.pose);
  score.width = best.width - truth.width;
  score.height = best.height - truth.height;
  score.detected = score.iou >= kMinIou && score.offset <= kMaxOffset && score.normal <= kMaxNormal;
  return score;
}

}  // namespace cabinet_articulation::core::evaluation
