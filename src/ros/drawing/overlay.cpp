// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/overlay.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "cabinet_articulation/joints/joint.h"
#include "ros/answers/joints.h"
#include "ros/drawing/model_drawing.h"
#include "ros/drawing/overlay_labels.h"
#include "ros/images/image_color.h"

namespace cabinet_articulation {
namespace {

constexpr double kNear = 0.1;  ///< [m] lines are cut off here
constexpr int kShift = 4;      ///< sub-pixel bits of OpenCV's drawing

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

  /// Nothing if it lies behind the camera; else within the image, or at its border.
  std::optional<cv::Point> place(const Eigen::Vector3d& p) const {
    if (!p.allFinite() || p.z() <= kNear) return std::nullopt;
    const cv::Point at = pixel(p, 0);
    return cv::Point(std::max(0, std::min(at.x, image_.cols - 1)), std::max(0, std::min(at.y, image_.rows - 1)));
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
  for (const core::Rectangle& front : sweepOf(model)) canvas->outline(front, imageColor(colorOf(model), 0.5), 1);
}

/// The axis, and the way of the front's centre from q = 0 to now.
void drawMotion(const core::LearnedModel& model, Canvas* canvas) {
  const auto axis = axisOf(model);
  canvas->line(axis.first, axis.second, imageColor(kAxisColor), 2);
  const std::vector<Eigen::Vector3d> way = wayOf(model, 0, model.q);
  for (size_t i = 1; i < way.size(); ++i) canvas->line(way[i - 1], way[i], imageColor(kWayColor), 2);
}

}  // namespace

void drawOverlay(const core::StereoCamera& camera, const std::vector<core::DetectedRectangle>& rectangles,
                 const std::vector<core::LearnedModel>& models, cv::Mat3b* image) {
  Canvas canvas(camera, image);
  for (const core::DetectedRectangle& detected : rectangles) canvas.outline(detected.rectangle, imageColor(kRectangleColor), 1);
  for (const core::LearnedModel& model : models)
    if (isJoint(model)) drawRange(model, &canvas);
  std::vector<OverlayLabel> labels;
  for (const core::LearnedModel& model : models) {
    const core::Rectangle front = frontAt(model, model.q);
    canvas.outline(front, imageColor(colorOf(model)), isJoint(model) ? 2 : 1);
    if (isJoint(model)) drawMotion(model, &canvas);
    const std::string label = isJoint(model) ? labelOf(model) : shortLabelOf(model);
    const std::optional<cv::Point> at = canvas.place(front.center());
    if (at) labels.push_back({label, *at, colorOf(model), gaugeOf(model)});
  }
  drawLabels(std::move(labels), image);
}

}  // namespace cabinet_articulation
