// SPDX-License-Identifier: BSD-3-Clause
#include "variants.h"

#include <cmath>

#include "ros/input_settings.h"

namespace cabinet_articulation::core::evaluation {
namespace {

cv::Mat1w depthImage(const DepthFrame& frame) {
  constexpr double kMillimetres = 1000;
  cv::Mat1w depth(frame.disparity.size(), std::uint16_t{0});
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      if (isValidDisparity(frame.disparity(v, u)))
        depth(v, u) = cv::saturate_cast<std::uint16_t>(kMillimetres * frame.camera.depth(frame.disparity(v, u)));
  return depth;
}

}  // namespace

Variant ourVariant() { return {"ours", {}, false}; }

Variant depthVariant() { return {"ours_depth", {}, true}; }

Variant paperVariant() { return {"paper", PipelineConfig::paper(), false}; }

Observer::Observer(const Variant& variant) : variant_(variant), matcher_(variant.config.stereo), pipeline_(variant.config) {}

PipelineResult Observer::see(const Frame& frame, const StereoCamera& camera) {
  if (!variant_.from_depth) return pipeline_.process(frame.stamp, frame.left, frame.right, camera, frame.T_world_camera);
  const cv::Mat1w depth = depthImage(matcher_.process(frame.left, frame.right, camera));
  StereoCamera depth_camera = camera;
  depth_camera.baseline = FrameInputConfig().virtual_baseline;
  depth_camera.cx_difference = 0;
  return pipeline_.process(frame.stamp, frameFromDepth(depth, depth_camera), frame.T_world_camera);
}

}  // namespace cabinet_articulation::core::evaluation
