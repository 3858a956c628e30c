// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/rectangles/edge_step.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace cabinet_articulation::core {
namespace {

constexpr int kStrips = EdgeProfile::kStrips;
constexpr int kMinStrips = 4;       ///< of a level
constexpr int kLevel = 12;          ///< strips (6 px) whose mean is the level on either side of the edge
constexpr float kClear = 1.5F;      ///< log residual from which a strip has left the plane for certain
constexpr int kBend = 12;           ///< strips (6 px) that a surface bending away is followed
constexpr int kMinBend = 5;         ///< strips that fix its slope
constexpr double kFollowed = 1;     ///< log residual by which it may be explained worse than the plane inside
constexpr double kMinSlope = 0.04;  ///< [px/px] of disparity across the edge
constexpr double kMaxBack = 4;      ///< [px] from where the bend is noticed back to where it begins
constexpr int kBlur = 4;            ///< strips (2 px) over which a sharp edge is blurred

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

/// The disparity offset [px] that suits a strip best, between the steps tried; nothing at the ends of the range.
std::optional<double> bestDisparity(const std::array<float, EdgeProfile::kOffsets>& cost) {
  const auto i = std::min_element(cost.begin(), cost.end()) - cost.begin();
  if (i == 0 || i == EdgeProfile::kOffsets - 1) return std::nullopt;
  // The residual itself, not its logarithm, is a parabola near its minimum.
  const double before = std::exp(cost[i - 1]), at = std::exp(cost[i]), after = std::exp(cost[i + 1]);
  const double curvature = before - 2 * at + after;
  const double shift = curvature > 0 ? (before - after) / (2 * curvature) : 0;
  return (static_cast<double>(i - EdgeProfile::kOnPlane) + shift) * EdgeProfile::kDisparityStep;
}

/// Where the surface beyond `border` bends away from the camera: its disparities, followed back to the plane's. Nothing if
/// no such surface follows or if it does not meet the plane near the border.
std::optional<double> bendOrigin(const EdgeProfile::Costs& costs, int border, double inside) {
  double n = 0, sx = 0, sd = 0, sxx = 0, sxd = 0;
  for (int k = border; k < std::min(border + kBend, kStrips); ++k) {
    const float best = *std::min_element(costs.cost[k].begin(), costs.cost[k].end());
    const std::optional<double> disparity = bestDisparity(costs.cost[k]);
    if (costs.weight[k] == 0 || !disparity) continue;
    if (best > inside + kFollowed) break;  // the surface has ended
    const double x = EdgeProfile::offset(k) + EdgeProfile::kStripWidth / 2;
    n += 1;
    sx += x;
    sd += *disparity;
    sxx += x * x;
    sxd += x * *disparity;
  }
  const double spread = n * sxx - sx * sx;
  if (n < kMinBend || spread <= 0) return std::nullopt;
  const double slope = (n * sxd - sx * sd) / spread;
  const double origin = (sx - sd / slope) / n;
  if (!(slope < -kMinSlope)) return std::nullopt;
  const double distance = EdgeProfile::offset(border) - origin;
  if (distance < 0 || distance > kMaxBack) return std::nullopt;
  return origin;
}

}  // namespace

EdgeStep findStep(const EdgeProfile::Costs& costs) {
  Values on_plane;
  std::vector<float> inside;
  for (int k = 0; k < kStrips; ++k) {
    on_plane[k] = costs.cost[k][EdgeProfile::kOnPlane];
    if (k < kStrips / 2 && costs.weight[k] > 0) inside.push_back(on_plane[k]);
  }
  EdgeStep step;
  if (inside.size() < kMinStrips) return step;
  std::nth_element(inside.begin(), inside.begin() + inside.size() / 2, inside.end());
  const float level = inside[inside.size() / 2];
  Values evidence;
  for (int k = 0; k < kStrips; ++k) {
    const float best_depth = *std::min_element(costs.cost[k].begin(), costs.cost[k].end());
    evidence[k] = std::clamp(on_plane[k] - std::min(level, best_depth), 0.F, kClear);
  }
  int border = splitLevels(evidence, costs.weight);
  if (border == 0) return step;
  // A sharp edge is blurred over a few strips; its place is where the residual is half way.
  const float inner = mean(on_plane, costs.weight, border - kBlur - kLevel, border - kBlur);
  const float outer = mean(on_plane, costs.weight, border + kBlur, border + kBlur + kLevel);
  for (int k = std::max(border - kBlur, 1); k < std::min(border + kBlur, kStrips); ++k)
    if (2 * on_plane[k - 1] < inner + outer && 2 * on_plane[k] >= inner + outer) {
      border = k;
      break;
    }
  step.offset = bendOrigin(costs, border, inner).value_or(EdgeProfile::offset(border));
  step.inside = inner;
  step.contrast = mean(on_plane, costs.weight, border, kStrips) - inner;
  return step;
}

}  // namespace cabinet_articulation::core
