// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_mask.h"

#include <cmath>

#include "cabinet_articulation/planes/disparity_tolerance.h"

namespace cabinet_articulation::core {
namespace {

constexpr float kNoCompetitor = 1e6F;  ///< [px]

struct RowPlane {
  float slope, start;  ///< disparity = slope u + start
};

RowPlane rowOf(const DisparityPlane& plane, int v) { return {static_cast<float>(plane.a), static_cast<float>(plane.at(0, v))}; }

// Selections without branches, so that the loops vectorise. A point in front of the plane has the larger disparity.
inline int chooseLabel(float disparity, float residual, float tolerance, int in_plane) {
  const int outside = residual > 0 ? kOccluded : kFree;
  const int label = std::abs(residual) <= tolerance ? in_plane : outside;
  return isValidDisparity(disparity) ? label : kUnknown;
}

__attribute__((target_clones("avx2", "default"))) void labelRow(const float* disparity, const float* competitor, int n,
                                                                RowPlane plane, DisparityTolerance tolerance, std::uint8_t* out) {
  for (int u = 0; u < n; ++u) {
    const float residual = disparity[u] - (plane.slope * u + plane.start);
    const int in_plane = std::abs(residual) > competitor[u] ? kOtherPlane : kInPlane;
    out[u] = static_cast<std::uint8_t>(chooseLabel(disparity[u], residual, tolerance.at(disparity[u]), in_plane));
  }
}

__attribute__((target_clones("avx2", "default"))) void labelRow(const float* disparity, int n, RowPlane plane, float tolerance,
                                                                std::uint8_t* out) {
  for (int u = 0; u < n; ++u) {
    const float residual = disparity[u] - (plane.slope * u + plane.start);
    out[u] = static_cast<std::uint8_t>(chooseLabel(disparity[u], residual, tolerance * disparity[u], kInPlane));
  }
}

__attribute__((target_clones("avx2", "default"))) void competeRow(const float* disparity, int begin, int end, RowPlane plane,
                                                                  float margin, float* competitor) {
  for (int u = begin; u < end; ++u)
    competitor[u] = std::min(competitor[u], std::abs(disparity[u] - (plane.slope * u + plane.start)) + margin);
}

}  // namespace

PlaneMask::PlaneMask(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

void PlaneMask::setFrame(const DepthFrame& frame, const RegionSet& set) {
  competitor_.create(frame.disparity.size());
  competitor_.setTo(kNoCompetitor);
  const float margin = static_cast<float>(config_.other_plane_margin);
  for (const GrownRegion& region : set.regions)
    for (int i = region.first_run; i < region.last_run; ++i) {
      const CellRun& run = set.runs[i];
      for (int v = run.row * kCell; v < (run.row + 1) * kCell; ++v)
        competeRow(frame.disparity[v], run.begin * kCell, run.end * kCell, rowOf(region.plane, v), margin, competitor_[v]);
    }
}

cv::Mat1b PlaneMask::label(const DepthFrame& frame, const DisparityPlane& plane) const {
  const DisparityTolerance tolerance(frame.camera, config_.mask_tolerance_px, config_.mask_tolerance_m, config_.tolerance_cap);
  cv::Mat1b mask(frame.disparity.size());
  for (int v = 0; v < mask.rows; ++v)
    labelRow(frame.disparity[v], competitor_[v], mask.cols, rowOf(plane, v), tolerance, mask[v]);
  return mask;
}

// With p = z r and disparity = f B / z, the distance to the plane is offset |disparity - disparity of the plane| / disparity.
cv::Mat1b labelByDistance(const DepthFrame& frame, const Plane& plane, double distance) {
  cv::Mat1b mask(frame.disparity.size());
  const auto image = toDisparityPlane(plane, frame.camera);
  if (!image) return mask = kUnknown;
  const float tolerance = static_cast<float>(distance / plane.offset);
  for (int v = 0; v < mask.rows; ++v) labelRow(frame.disparity[v], mask.cols, rowOf(*image, v), tolerance, mask[v]);
  return mask;
}

}  // namespace cabinet_articulation::core
