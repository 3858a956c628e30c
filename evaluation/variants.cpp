// SPDX-License-Identifier: BSD-3-Clause
#include "variants.h"

#include <cmath>

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

Variant ourVariant() { return {"ours", {}, true, false}; }

Variant depthVariant() { return {"ours_depth", {}, true, true}; }

Variant paperVariant() {
  Variant variant{"paper", {}, false, false};
  variant.config.planes.method = "paper";
  RectanglesConfig& rectangles = variant.config.rectangles;
  rectangles.objective = "paper";
  rectangles.random_starts = 10;  // the original release's launch files
  rectangles.first_step = 0.05;
  rectangles.refine_edges = false;
  rectangles.min_precision = 0.7;
  rectangles.min_recall = 0.7;
  rectangles.min_visible = 0;
  rectangles.min_side = 0.05;
  rectangles.max_side = 1.5;
  return variant;
}

Observer::Observer(const Variant& variant) : variant_(variant), matcher_(variant.config.stereo), pipeline_(variant.config) {}

PipelineResult Observer::see(const Frame& frame, const StereoCamera& camera) {
  if (!variant_.tracks_guide) forget();
  if (!variant_.from_depth) return pipeline_.process(frame.stamp, frame.left, frame.right, camera, frame.T_world_camera);
  const cv::Mat1w depth = depthImage(matcher_.process(frame.left, frame.right, camera));
  return pipeline_.process(frame.stamp, frameFromDepth(depth, camera), frame.T_world_camera);
}

}  // namespace cabinet_articulation::core::evaluation
