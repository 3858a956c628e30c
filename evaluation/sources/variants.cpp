// SPDX-License-Identifier: BSD-3-Clause
#include "sources/variants.h"

#include "ros/input/input_settings.h"
#include "stereo/whole_millimetres.h"

namespace cabinet_articulation::core::evaluation {
namespace {

DepthFrame fromDepthCamera(const cv::Mat1w& depth, StereoCamera camera) {
  camera.baseline = FrameInputConfig().virtual_baseline;
  camera.cx_difference = 0;
  return frameFromDepth(depth, camera);
}

}  // namespace

DepthFrame depthFrame(const Frame& frame, const StereoCamera& camera, BlockMatcher* matcher) {
  return frame.depth.empty() ? matcher->process(frame.left, frame.right, camera) : fromDepthCamera(frame.depth, camera);
}

Variant ourVariant() { return {"ours", {}, false}; }

Variant depthVariant() { return {"ours_depth", {}, true}; }

Variant paperVariant() { return {"paper", PipelineConfig::paper(), false}; }

Observer::Observer(const Variant& variant) : variant_(variant), matcher_(variant.config.stereo), pipeline_(variant.config) {}

PipelineResult Observer::see(const Frame& frame, const StereoCamera& camera) {
  const bool has_pair = frame.depth.empty();
  if (has_pair && !variant_.from_depth)
    return pipeline_.process(frame.stamp, frame.left, frame.right, camera, frame.T_world_camera);
  const cv::Mat1w depth = has_pair ? wholeMillimetres(matcher_.process(frame.left, frame.right, camera)) : frame.depth;
  return pipeline_.process(frame.stamp, fromDepthCamera(depth, camera), frame.T_world_camera);
}

}  // namespace cabinet_articulation::core::evaluation
