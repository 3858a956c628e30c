// SPDX-License-Identifier: BSD-3-Clause
#include "sources/variants.h"

#include "ros/input/input_settings.h"
#include "stereo/whole_millimetres.h"

namespace cabinet_articulation::core::evaluation {
Variant ourVariant() { return {"ours", {}, false}; }

Variant depthVariant() { return {"ours_depth", {}, true}; }

Variant paperVariant() { return {"paper", PipelineConfig::paper(), false}; }

Observer::Observer(const Variant& variant) : variant_(variant), matcher_(variant.config.stereo), pipeline_(variant.config) {}

PipelineResult Observer::see(const Frame& frame, const StereoCamera& camera) {
  const bool has_pair = frame.depth.empty();
  if (has_pair && !variant_.from_depth)
    return pipeline_.process(frame.stamp, frame.left, frame.right, camera, frame.T_world_camera);
  const cv::Mat1w depth = has_pair ? wholeMillimetres(matcher_.process(frame.left, frame.right, camera)) : frame.depth;
  StereoCamera depth_camera = camera;
  depth_camera.baseline = FrameInputConfig().virtual_baseline;
  depth_camera.cx_difference = 0;
  return pipeline_.process(frame.stamp, frameFromDepth(depth, depth_camera), frame.T_world_camera);
}

}  // namespace cabinet_articulation::core::evaluation
