// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "tools/report/canvas.h"

namespace cabinet_articulation {

/// Draws into a picture (BGR).
class ImageCanvas : public Canvas {
 public:
  /// White.
  ImageCanvas(int width, int height) : image_(height, width, cv::Vec3b::all(255)) {}

  void line(const std::vector<Eigen::Vector2d>& points, const Stroke& stroke) override;
  void fill(const Box& box, const Color& color) override;
  void dot(const Eigen::Vector2d& center, double radius, const Color& color) override;
  void text(const Eigen::Vector2d& at, const std::string& words, Anchor anchor, bool bold) override;
  double widthOf(const std::string& words) const override;

  const cv::Mat3b& image() const { return image_; }

 private:
  cv::Mat3b image_;
};

}  // namespace cabinet_articulation
