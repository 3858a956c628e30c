// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/frame_pictures.h"

#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/joints/hanging.h"
#include "ros/drawing/model_drawing.h"
#include "ros/drawing/overlay.h"

namespace cabinet_articulation {
namespace {

constexpr double kFarthest = 4;  ///< [m] white in a picture made from depth
constexpr int kQuality = 80;     ///< of JPEG: no artefacts at lines that disturb

/// The left image, or the depth in grey: what was not measured is black.
cv::Mat3b background(const core::DepthFrame& frame) {
  cv::Mat1b grey = frame.left;
  if (grey.empty()) {
    grey.create(frame.disparity.size());
    for (int v = 0; v < grey.rows; ++v)
      for (int u = 0; u < grey.cols; ++u) {
        const float disparity = frame.disparity(v, u);
        const bool valid = core::isValidDisparity(disparity);
        grey(v, u) = valid ? cv::saturate_cast<std::uint8_t>(255 / kFarthest * frame.camera.depth(disparity)) : std::uint8_t{0};
      }
  }
  cv::Mat3b picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  return picture;
}

Picture pictureOf(double time, const core::PipelineResult& result, const Eigen::Isometry3d& T_fixed_camera) {
  const Eigen::Isometry3d T_camera_fixed = T_fixed_camera.inverse();
  std::vector<core::LearnedModel> models;
  for (const core::LearnedModel& model : core::allPlaced(result.models)) models.push_back(transformed(model, T_camera_fixed));
  cv::Mat3b image = background(result.frame);
  drawOverlay(result.frame.camera, result.rectangles, models, &image);
  Picture picture;
  picture.time = time;
  cv::imencode(".jpg", image, picture.jpeg, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return picture;
}

}  // namespace

void FramePictures::add(double time, const core::PipelineResult& result, const Eigen::Isometry3d& T_fixed_camera,
                        const std::vector<std::uint32_t>& new_joints) {
  evenly_spaced_.offer([&] { return pictureOf(time, result, T_fixed_camera); });
  if (new_joints.empty()) return;
  const Picture picture = pictureOf(time, result, T_fixed_camera);
  for (const std::uint32_t joint : new_joints) first_[joint] = picture;
  // Clutter may have been told to be a joint for a moment: ids grow, and what was learned at last is on the page.
  while (first_.size() > kMostJoints) first_.erase(first_.begin());
}

const Picture* FramePictures::firstOf(std::uint32_t joint) const {
  const auto found = first_.find(joint);
  return found == first_.end() ? nullptr : &found->second;
}

}  // namespace cabinet_articulation
