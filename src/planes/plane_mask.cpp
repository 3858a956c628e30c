// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_mask.h"

#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// One image row of a plane: disparity = slope u + start.
struct RowPlane {
  RowPlane(const DisparityPlane& plane, int v) : slope(static_cast<float>(plane.a)), start(static_cast<float>(plane.at(0, v))) {}
  float at(int u) const { return slope * static_cast<float>(u) + start; }
  float slope, start;
};

// Selections without branches, so that the loops vectorise. A point in front of the plane has the larger disparity.
inline std::uint8_t chooseLabel(float disparity, float residual, float tolerance, int in_plane) {
  const int outside = residual > 0 ? kOccluded : kFree;
  const int label = std::abs(residual) <= tolerance ? in_plane : outside;
  return static_cast<std::uint8_t>(isValidDisparity(disparity) ? label : kUnknown);
}

__attribute__((target_clones("avx2", "default"))) void labelRow(const float* disparity, const float* limit, int n, RowPlane plane,
                                                                DisparityTolerance tolerance, std::uint8_t* out) {
  for (int u = 0; u < n; ++u) {
    const float residual = disparity[u] - plane.at(u);
    const int in_plane = std::abs(residual) > limit[u] ? kOtherPlane : kInPlane;
    out[u] = chooseLabel(disparity[u], residual, tolerance.at(disparity[u]), in_plane);
  }
}

__attribute__((target_clones("avx2", "default"))) void labelRow(const float* disparity, int n, RowPlane plane, float tolerance,
                                                                std::uint8_t* out) {
  for (int u = 0; u < n; ++u) out[u] = chooseLabel(disparity[u], disparity[u] - plane.at(u), tolerance * disparity[u], kInPlane);
}

}  // namespace

void labelByNoise(const cv::Mat1f& disparity, const DisparityPlane& plane, const DisparityTolerance& tolerance,
                  const cv::Mat1f& limit, cv::Mat1b* mask) {
  mask->create(disparity.size());
  for (int v = 0; v < mask->rows; ++v) labelRow(disparity[v], limit[v], mask->cols, RowPlane(plane, v), tolerance, (*mask)[v]);
}

// With p = z r and disparity = f B / z, the distance to the plane is offset |disparity - disparity of the plane| / disparity.
void labelByDistance(const DepthFrame& frame, const Plane& plane, double distance, cv::Mat1b* mask) {
  mask->create(frame.disparity.size());
  const auto image = toDisparityPlane(plane, frame.camera);
  if (!image) {
    mask->setTo(kUnknown);
    return;
  }
  const float tolerance = static_cast<float>(distance / plane.offset);
  for (int v = 0; v < mask->rows; ++v) labelRow(frame.disparity[v], mask->cols, RowPlane(*image, v), tolerance, (*mask)[v]);
}

}  // namespace cabinet_articulation::core
