// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/refit/depth_refit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planes/plane_fit.h"
#include "planes/region_growing.h"
#include "rectangles/chart/depth_noise.h"
#include "rectangles/chart/image_spans.h"
#include "rectangles/refit/plane_refit.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kFits = 4;  ///< each without the outliers of the one before (ours)

struct Residuals {
  PlaneFit fit;
  int looked_at = 0;  ///< [pixels] on the plane, or without a depth
};

/// Of the residuals [px] of a plane that are within `limit`, in every other row and column.
Residuals fitResiduals(const DepthFrame& frame, const cv::Mat1b& mask, const ImageQuad& quad, const DisparityPlane& plane,
                       double limit) {
  Residuals residuals;
  forEachSpan(quad, mask.cols, mask.rows, kCell, [&](int v, int u_begin, int u_end) {
    for (int u = u_begin; u < u_end; u += kCell) {
      const std::uint8_t label = mask(v, u);
      residuals.looked_at += label == kInPlane || label == kOtherPlane || label == kUnknown;
      const float disparity = frame.disparity(v, u);
      if ((label != kInPlane && label != kOtherPlane) || !isValidDisparity(disparity)) continue;
      const double residual = disparity - plane.at(u, v);
      if (std::abs(residual) <= limit) residuals.fit.add(u, v, residual);
    }
  });
  return residuals;
}

/// Gives a rectangle the size of `sized`. Its middle stays, but for an axis with one edge at a crease.
void putSizeBack(const PlaneRectangle& sized, const HiddenBehind& hidden, PlaneRectangle* rectangle) {
  const auto stays = [&](Edge edge) { return hidden[edge].has_value(); };
  for (const auto& [minus, plus] : {std::pair(kEdgeMinusX, kEdgePlusX), std::pair(kEdgeMinusY, kEdgePlusY)}) {
    const double change = sized.side(edgeAxis(minus)) - rectangle->side(edgeAxis(minus));
    const double share = stays(minus) == stays(plus) ? change / 2 : stays(minus) ? 0 : change;
    rectangle->moveEdge(minus, share);
    rectangle->moveEdge(plus, change - share);
  }
}

}  // namespace

bool refitByDepth(const DepthFrame& frame, RectangleCandidate* candidate) {
  const std::optional<ImageQuad> quad = candidate->chart.project(candidate->rectangle);
  if (!quad) return false;
  DisparityPlane plane = candidate->region.disparity_plane;
  double limit = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kFits; ++i) {
    const auto [fit, looked_at] = fitResiduals(frame, candidate->region.mask, *quad, plane, limit);
    const auto change = fit.solve();
    if (!change || 2 * fit.count() < looked_at) return false;
    plane = {plane.a + change->a, plane.b + change->b, plane.c + change->c};
    limit = kOutlier * std::max(kLeastSigma, std::sqrt(fit.squares(*change) / fit.count()));
  }
  return moveToPlane(plane, *quad, frame.camera, candidate);
}

bool refitAtCrease(const PlaneRectangle& refined, const HiddenBehind& hidden, const DepthFrame& frame,
                   RectangleCandidate* candidate) {
  if (std::none_of(hidden.begin(), hidden.end(), [](const auto& behind) { return behind.has_value(); })) return false;
  const PlaneRectangle before = std::exchange(candidate->rectangle, refined);
  const bool is_fitted = refitByDepth(frame, candidate);
  if (!is_fitted)
    candidate->rectangle = before;
  else if (candidate->guided)
    putSizeBack(before, hidden, &candidate->rectangle);
  return is_fitted;
}

}  // namespace cabinet_articulation::core
