// SPDX-License-Identifier: BSD-3-Clause
#include "tables/failure_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>

#include "geometry/degrees.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr int kScale = 2;

/// The farther, the brighter; black where there is no depth.
cv::Mat1b picture(const Frame& frame) {
  if (frame.depth.empty()) return frame.left;
  cv::Mat1b picture;
  double farthest = 0;
  cv::minMaxIdx(frame.depth, nullptr, &farthest);
  frame.depth.convertTo(picture, CV_8U, 255 / std::max(farthest, 1.0));
  return picture;
}

void drawRectangle(const Rectangle& rectangle, const StereoCamera& camera, const cv::Scalar& color, cv::Mat3b* image) {
  std::vector<cv::Point> outline;
  for (const Eigen::Vector3d& corner : rectangle.corners()) {
    if (corner.z() <= 0) return;
    const Eigen::Vector2d pixel = kScale * camera.project(corner);
    outline.emplace_back(std::lround(pixel.x()), std::lround(pixel.y()));
  }
  cv::polylines(*image, outline, true, color, 1, cv::LINE_AA);
}

}  // namespace

cv::Mat3b drawFailure(const Frame& frame, const StereoCamera& camera, const Rectangle& truth,
                      const std::vector<DetectedRectangle>& rectangles, const DetectionScore& score) {
  cv::Mat large;
  cv::resize(picture(frame), large, {}, kScale, kScale, cv::INTER_LINEAR);
  cv::Mat3b image;
  cv::cvtColor(large, image, cv::COLOR_GRAY2BGR);
  for (const DetectedRectangle& other : rectangles) drawRectangle(other.rectangle, camera, {255, 160, 60}, &image);
  if (score.best >= 0) drawRectangle(rectangles[score.best].rectangle, camera, {60, 60, 255}, &image);
  drawRectangle(truth, camera, {60, 220, 60}, &image);
  char text[160] = "nothing overlaps the front";
  if (score.best >= 0)
    std::snprintf(text, sizeof(text), "IoU %.2f  offset %.0f mm  normal %.1f deg  width %+.0f mm  height %+.0f mm", score.iou,
                  1e3 * score.offset, toDegrees(score.normal), 1e3 * score.width, 1e3 * score.height);
  cv::putText(image, text, {10, 24}, cv::FONT_HERSHEY_SIMPLEX, 0.6, {255, 255, 255}, 1, cv::LINE_AA);
  return image;
}

}  // namespace cabinet_articulation::core::evaluation
