// SPDX-License-Identifier: BSD-3-Clause
#include "ros/overlay.h"

#include <opencv2/imgproc.hpp>

#include "ros/joints.h"
#include "ros/model_drawing.h"

namespace cabinet_articulation {
namespace {

constexpr double kNear = 0.1;  ///< [m] lines are cut off here
constexpr int kShift = 4;      ///< sub-pixel bits of OpenCV's drawing
constexpr double kFontScale = 0.45;

cv::Scalar scalar(const Color& color, double brightness = 1) {
  return {255 * brightness * color[2], 255 * brightness * color[1], 255 * brightness * color[0]};
}

class Canvas {
 public:
  Canvas(const core::StereoCamera& camera, cv::Mat3b* image) : camera_(camera), image_(*image) {}

  void line(Eigen::Vector3d a, Eigen::Vector3d b, const cv::Scalar& color, int thickness) {
    if (!a.allFinite() || !b.allFinite()) return;
    if (a.z() > b.z()) std::swap(a, b);
    if (b.z() <= kNear) return;
    if (a.z() < kNear) a += (b - a) * ((kNear - a.z()) / (b.z() - a.z()));
    cv::Point from = pixel(a, kShift), to = pixel(b, kShift);
    const cv::Size size(image_.cols << kShift, image_.rows << kShift);
    if (cv::clipLine(size, from, to)) cv::line(image_, from, to, color, thickness, cv::LINE_AA, kShift);
  }

  void outline(const core::Rectangle& rectangle, const cv::Scalar& color, int thickness) {
    const auto corners = rectangle.corners();
    for (size_t i = 0; i < corners.size(); ++i) line(corners[i], corners[(i + 1) % corners.size()], color, thickness);
  }

  /// Dark below bright, readable on any background; kept inside the image.
  void text(const std::string& text, const Eigen::Vector3d& p, const cv::Scalar& color) {
    if (!p.allFinite() || p.z() <= kNear) return;
    const cv::Size size = cv::getTextSize(text, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, nullptr);
    cv::Point at = pixel(p, 0) - cv::Point(size.width / 2, 0);
    at.x = std::max(2, std::min(at.x, image_.cols - size.width - 2));
    at.y = std::max(size.height + 2, std::min(at.y, image_.rows - 4));
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, kFontScale, cv::Scalar::all(0), 3, cv::LINE_AA);
    cv::putText(image_, text, at, cv::FONT_HERSHEY_SIMPLEX, kFontScale, color, 1, cv::LINE_AA);
  }

 private:
  cv::Point pixel(const Eigen::Vector3d& p, int shift) const {
    constexpr double kFar = 1e6;  // keeps the fixed-point numbers of OpenCV in range
    const Eigen::Vector2d uv = (camera_.project(p) * (1 << shift)).cwiseMax(-kFar).cwiseMin(kFar);
    return {cvRound(uv.x()), cvRound(uv.y())};
  }

  core::StereoCamera camera_;
  cv::Mat3b image_;  ///< shares the pixels
};

void drawRange(const core::LearnedModel& model, Canvas* canvas) {
  for (const core::Rectangle& front : sweepOf(model)) canvas->outline(front, scalar(colorOf(model), 0.5), 1);
}

/// The axis, and the way of the front's centre from q = 0 to now.
void drawMotion(const core::LearnedModel& model, Canvas* canvas) {
  const auto axis = axisOf(model);
  canvas->line(axis.first, axis.second, scalar({1.0F, 0.25F, 0.25F}), 2);
  const std::vector<Eigen::Vector3d> way = wayOf(model, 0, model.q);
  for (size_t i = 1; i < way.size(); ++i) canvas->line(way[i - 1], way[i], scalar({1.0F, 1.0F, 1.0F}), 2);
}

}  // namespace

void drawOverlay(const core::StereoCamera& camera, const std::vector<core::DetectedRectangle>& rectangles,
                 const std::vector<core::LearnedModel>& models, cv::Mat3b* image) {
  Canvas canvas(camera, image);
  for (const core::DetectedRectangle& detected : rectangles) canvas.outline(detected.rectangle, scalar({1.0F, 0.9F, 0.3F}), 1);
  for (const core::LearnedModel& model : models)
    if (isJoint(model)) drawRange(model, &canvas);
  for (const core::LearnedModel& model : models) {
    const core::Rectangle front = frontAt(model, model.q);
    canvas.outline(front, scalar(colorOf(model)), isJoint(model) ? 2 : 1);
    if (isJoint(model)) drawMotion(model, &canvas);
    const std::string label = isJoint(model) ? labelOf(model) : std::to_string(model.id);
    canvas.text(label, front.center(), scalar(colorOf(model)));
  }
}

}  // namespace cabinet_articulation
