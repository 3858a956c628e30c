// SPDX-License-Identifier: BSD-3-Clause
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "cabinet_articulation/stereo/block_matcher.h"
#include "stereo/image_text.h"
#include "stereo/whole_millimetres.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kMillimetresPerMetre = 1000;

/// `numerator` is focal length times baseline in the depth's own unit.
template <class Depth>
void toDisparity(const cv::Mat& depth, float numerator, cv::Mat1f* disparity) {
  for (int v = 0; v < depth.rows; ++v) {
    const Depth* in = depth.ptr<Depth>(v);
    float* out = (*disparity)[v];
    for (int u = 0; u < depth.cols; ++u) {
      const float value = numerator / static_cast<float>(in[u]);
      out[u] = isValidDisparity(value) ? value : 0.0F;
    }
  }
}

}  // namespace

DepthFrame frameFromDepth(const cv::Mat& depth, const StereoCamera& camera, double unit) {
  assert(unit > 0);
  if (depth.type() != CV_32FC1 && depth.type() != CV_16UC1)
    throw std::invalid_argument("the depth image is " + describeImage(depth) +
                                ", expected 1 channel with 32 bit floats (metres) or 16 bit integers");
  if (depth.cols != camera.width || depth.rows != camera.height)
    throw std::invalid_argument("the depth image is " + describeImage(depth) + ", but its camera is " +
                                std::to_string(camera.width) + "x" + std::to_string(camera.height) + " px");
  DepthFrame frame;
  frame.camera = camera;
  frame.disparity.create(depth.size());
  const double numerator = camera.focalBaseline();
  if (depth.type() == CV_32FC1)
    toDisparity<float>(depth, static_cast<float>(numerator), &frame.disparity);
  else
    toDisparity<std::uint16_t>(depth, static_cast<float>(numerator / unit), &frame.disparity);
  return frame;
}

cv::Mat1w wholeMillimetres(const DepthFrame& frame) {
  cv::Mat1w depth(frame.disparity.size(), std::uint16_t{0});
  for (int v = 0; v < depth.rows; ++v)
    for (int u = 0; u < depth.cols; ++u)
      if (isValidDisparity(frame.disparity(v, u)))
        depth(v, u) = cv::saturate_cast<std::uint16_t>(kMillimetresPerMetre * frame.camera.depth(frame.disparity(v, u)));
  return depth;
}

}  // namespace cabinet_articulation::core
