// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/refit/depth_refit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/plane_fit.h"
#include "planes/region_growing.h"
#include "rectangles/chart/depth_noise.h"
#include "rectangles/chart/image_spans.h"
#include "rectangles/refit/plane_refit.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kFits = 4;  ///< each without the outliers of the one before (ours)

/// Of the residuals [px] of a plane that are within `limit`, in every other row and column.
PlaneFit fitResiduals(const DepthFrame& frame, const cv::Mat1b& mask, const ImageQuad& quad, const DisparityPlane& plane,
                      double limit) {
  PlaneFit fit;
  forEachSpan(quad, mask.cols, mask.rows, kCell, [&](int v, int u_begin, int u_end) {
    for (int u = u_begin; u < u_end; u += kCell) {
      const std::uint8_t label = mask(v, u);
      const float disparity = frame.disparity(v, u);
      if ((label != kInPlane && label != kOtherPlane) || !isValidDisparity(disparity)) continue;
      const double residual = disparity - plane.at(u, v);
      if (std::abs(residual) <= limit) fit.add(u, v, residual);
    }
  });
  return fit;
}

}  // namespace

bool refitByDepth(const DepthFrame& frame, RectangleCandidate* candidate) {
  const std::optional<ImageQuad> quad = candidate->chart.project(candidate->rectangle);
  if (!quad) return false;
  DisparityPlane plane = candidate->region.disparity_plane;
  double limit = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kFits; ++i) {
    const PlaneFit fit = fitResiduals(frame, candidate->region.mask, *quad, plane, limit);
    const auto change = fit.solve();
    if (!change) return false;
    plane = {plane.a + change->a, plane.b + change->b, plane.c + change->c};
    limit = kOutlier * std::max(kLeastSigma, std::sqrt(fit.squares(*change) / fit.count()));
  }
  return moveToPlane(plane, *quad, frame.camera, candidate);
}

}  // namespace cabinet_articulation::core
