// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/edge_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace cabinet_articulation::core {
namespace {

constexpr int kStrips = EdgeProfile::kStrips;
constexpr int kMinStrips = 4;                ///< of a level
constexpr int kLevel = 12;                   ///< strips (6 px) whose mean is the level on either side of the edge
constexpr double kSmallestResidual = 0.015;  ///< what interpolation alone leaves unexplained
constexpr float kClear = 1.5F;               ///< log residual from which a strip has left the plane for certain
constexpr int kBend = 12;                    ///< strips (6 px) that a surface bending away is followed
constexpr int kMinBend = 3;                  ///< strips that show it
constexpr double kFollowed = 1;              ///< log residual by which it may be explained worse than the plane inside
constexpr double kMaxUnexplained = 0.3;      ///< share of the disparities' squares that the bend may leave
constexpr double kMinDrop = 0.4;             ///< [px] of disparity by which it has fallen where it ends
constexpr int kMaxBack = 8;                  ///< strips (4 px) from where the bend is noticed back to where it begins
constexpr int kBlur = 4;                     ///< strips (2 px) over which a sharp edge is blurred

using Values = std::array<float, kStrips>;

/// Mean of the values over the strips [begin, end), weighted by how full they are.
float mean(const Values& values, const Values& weight, int begin, int end) {
  float sum = 0, total = 0;
  for (int k = std::max(begin, 0); k < std::min(end, kStrips); ++k) {
    sum += weight[k] * values[k];
    total += weight[k];
  }
  return total > 0 ? sum / total : 0;
}

/// The border of the best two levels in the least squares sense; 0 if the values do not rise.
int splitLevels(const Values& values, const Values& weight) {
  float total = 0, total_weight = 0;
  for (int k = 0; k < kStrips; ++k) {
    total += weight[k] * values[k];
    total_weight += weight[k];
  }
  float inner = 0, inner_weight = 0, best_between = 0;
  int best = 0;
  for (int k = 0; k + kMinStrips < kStrips; ++k) {
    inner += weight[k] * values[k];
    inner_weight += weight[k];
    const float outer_weight = total_weight - inner_weight;
    if (inner_weight < kMinStrips || outer_weight < kMinStrips) continue;
    const float rise = (total - inner) / outer_weight - inner / inner_weight;
    const float between = inner_weight * outer_weight * rise * rise;  // maximal variance between the levels
    if (rise <= 0 || between <= best_between) continue;
    best_between = between;
    best = k + 1;
  }
  return best;
}

/// The depth that suits a strip best.
struct BestDepth {
  double disparity;  ///< [px] relative to the plane
  double log_residual;
};

double logResidual(double residual) { return std::log(std::max(residual, kSmallestResidual)); }

BestDepth bestDepth(const std::array<float, EdgeProfile::kOffsets>& residual) {
  const auto i = std::min_element(residual.begin(), residual.end()) - residual.begin();
  BestDepth best{static_cast<double>(i - EdgeProfile::kOnPlane), residual[i]};
  if (i > 0 && i < EdgeProfile::kOffsets - 1) {  // the parabola through three samples
    const double slope = (residual[i + 1] - residual[i - 1]) / 2;
    const double curvature = residual[i + 1] - 2 * residual[i] + residual[i - 1];
    if (curvature > 0) {
      best.disparity -= slope / curvature;
      best.log_residual -= slope * slope / (2 * curvature);
    }
  }
  best.log_residual = logResidual(best.log_residual);
  return best;
}

/// Where the surface beyond `border` bends away from the camera: the kink of the line that fits the strips' disparities,
/// which is 0 inside and falls steadily outside. Nothing if no such surface follows.
std::optional<double> bendOrigin(const EdgeProfile::Residuals& residuals, int border, double inside) {
  std::array<double, kStrips> disparity;
  const int begin = std::max(border - 2 * kMaxBack, 0);
  int end = begin;
  for (; end < std::min(border + kBend, kStrips); ++end) {
    const BestDepth best = bestDepth(residuals.residual[end]);
    if (end >= border && best.log_residual > inside + kFollowed) break;  // the surface has ended
    disparity[end] = best.disparity;
  }
  if (end - border < kMinBend) return std::nullopt;
  double least = std::numeric_limits<double>::infinity();
  std::optional<double> origin;
  for (int kink = border - kMaxBack; kink <= border; ++kink) {
    double xx = 0, xd = 0, dd = 0;
    for (int k = begin; k < end; ++k) {
      const double x = std::max((k - kink + 0.5) * EdgeProfile::kStripWidth, 0.0);
      const double weight = residuals.weight[k];
      xx += weight * x * x;
      xd += weight * x * disparity[k];
      dd += weight * disparity[k] * disparity[k];
    }
    if (xx <= 0 || dd - xd * xd / xx >= least) continue;
    least = dd - xd * xd / xx;
    const double drop = -xd / xx * (end - kink) * EdgeProfile::kStripWidth;
    origin = drop > kMinDrop && least < kMaxUnexplained * dd ? std::make_optional(EdgeProfile::offset(kink)) : std::nullopt;
  }
  return origin;
}

}  // namespace

EdgeStep findStep(const EdgeProfile::Residuals& residuals) {
  Values on_plane;
  std::vector<float> inside;
  for (int k = 0; k < kStrips; ++k) {
    on_plane[k] = logResidual(residuals.residual[k][EdgeProfile::kOnPlane]);
    if (k < kStrips / 2 && residuals.weight[k] > 0) inside.push_back(on_plane[k]);
  }
  EdgeStep step;
  if (inside.size() < kMinStrips) return step;
  std::nth_element(inside.begin(), inside.begin() + inside.size() / 2, inside.end());
  const float level = inside[inside.size() / 2];
  Values evidence;
  for (int k = 0; k < kStrips; ++k) {
    const double explained = std::min<double>(level, bestDepth(residuals.residual[k]).log_residual);
    evidence[k] = std::clamp(static_cast<float>(on_plane[k] - explained), 0.F, kClear);
  }
  int border = splitLevels(evidence, residuals.weight);
  if (border == 0) return step;
  // A sharp edge is blurred over a few strips; its place is where the residual is half way.
  const float inner = mean(on_plane, residuals.weight, border - kBlur - kLevel, border - kBlur);
  const float outer = mean(on_plane, residuals.weight, border + kBlur, border + kBlur + kLevel);
  for (int k = std::max(border - kBlur, 1); k < std::min(border + kBlur, kStrips); ++k)
    if (2 * on_plane[k - 1] < inner + outer && 2 * on_plane[k] >= inner + outer) {
      border = k;
      break;
    }
  step.offset = bendOrigin(residuals, border, inner).value_or(EdgeProfile::offset(border));
  step.inside = inner;
  step.contrast = mean(on_plane, residuals.weight, border, kStrips) - inner;
  return step;
}

}  // namespace cabinet_articulation::core
