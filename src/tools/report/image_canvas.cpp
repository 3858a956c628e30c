// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/image_canvas.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "ros/images/image_color.h"

namespace cabinet_articulation {
namespace {

constexpr int kShift = 4;  ///< sub-pixel bits of OpenCV's drawing
constexpr double kFontScale = 0.42;
constexpr double kDash = 5, kGap = 4;

cv::Point subPixels(const Eigen::Vector2d& p) { return {cvRound(p.x() * (1 << kShift)), cvRound(p.y() * (1 << kShift))}; }

}  // namespace

void ImageCanvas::line(const std::vector<Eigen::Vector2d>& points, const Stroke& stroke) {
  const int width = std::max(1, cvRound(stroke.width));
  const auto draw = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    cv::line(image_, subPixels(a), subPixels(b), imageColor(stroke.color), width, cv::LINE_AA, kShift);
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector2d way = points[i] - points[i - 1];
    const double length = way.norm();
    if (!stroke.dashed || length == 0) {
      draw(points[i - 1], points[i]);
      continue;
    }
    for (double from = 0; from < length; from += kDash + kGap)
      draw(points[i - 1] + way * (from / length), points[i - 1] + way * (std::min(from + kDash, length) / length));
  }
}

void ImageCanvas::fill(const Box& box, const Color& color) {
  const cv::Point from(cvRound(box.left), cvRound(box.top)), to(cvRound(box.right()), cvRound(box.bottom()));
  const cv::Rect inside = cv::Rect(from, to) & cv::Rect(0, 0, image_.cols, image_.rows);
  image_(inside).setTo(imageColor(color));
}

void ImageCanvas::dot(const Eigen::Vector2d& center, double radius, const Color& color) {
  cv::circle(image_, subPixels(center), cvRound(radius * (1 << kShift)), imageColor(color), cv::FILLED, cv::LINE_AA, kShift);
}

void ImageCanvas::text(const Eigen::Vector2d& at, const std::string& words, Anchor anchor, bool bold) {
  const double left = at.x() - widthOf(words) * (anchor == Anchor::kStart ? 0 : anchor == Anchor::kMiddle ? 0.5 : 1);
  const cv::Point from(cvRound(left), cvRound(at.y()));
  cv::putText(image_, words, from, cv::FONT_HERSHEY_SIMPLEX, kFontScale, cv::Scalar::all(40), 1, cv::LINE_AA);
  // A second time beside it, for Hershey's fonts have one weight.
  if (bold)
    cv::putText(image_, words, from + cv::Point(1, 0), cv::FONT_HERSHEY_SIMPLEX, kFontScale, cv::Scalar::all(40), 1, cv::LINE_AA);
}

double ImageCanvas::widthOf(const std::string& words) const {
  return cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, kFontScale, 1, nullptr).width;
}

}  // namespace cabinet_articulation
