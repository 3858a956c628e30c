// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/edge_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "rectangles/edges/side_face.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kStrips = EdgeProfile::kStrips;
constexpr int kMinStrips = 4;                ///< of a level
constexpr int kLevel = 12;                   ///< strips (6 px) whose mean is the level on either side of the edge
constexpr double kSmallestResidual = 0.015;  ///< what interpolation alone leaves unexplained
constexpr float kClear = 1.5F;               ///< log residual from which a strip has left the plane for certain
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

/// The first place [strips] about `border` where the values fall below `limit`, between the middles of two strips.
std::optional<float> fall(const Values& values, const Values& weight, int border, float limit) {
  int last = -1;
  for (int k = std::max(border - kBlur - 1, 0); k < std::min(border + kBlur, kStrips); ++k) {
    if (weight[k] == 0) continue;
    if (last >= 0 && values[last] > limit && values[k] <= limit)
      return static_cast<float>(last) + 0.5F + static_cast<float>(k - last) * (values[last] - limit) / (values[last] - values[k]);
    last = k;
  }
  return std::nullopt;
}

/// [strips] A sharp edge is blurred over a few strips about `border`. At its place half of each image is still the plane's, and
/// so is a quarter of their covariance, however dark it is beyond: in a shadow the least of blur suffices for the images to
/// agree. Where they agree beyond, too, because another surface follows at once, the place is where the log residual is half
/// way.
float placeOfEdge(const Values& on_plane, const EdgeProfile::Residuals& residuals, int border) {
  const Values& weight = residuals.weight;
  const auto inner = [&](const Values& values) { return mean(values, weight, border - kBlur - kLevel, border - kBlur); };
  const auto outer = [&](const Values& values) { return mean(values, weight, border + kBlur, border + kBlur + kLevel); };
  const float seen = inner(residuals.signal), rest = outer(residuals.signal);
  if (rest < seen / 2)
    if (const auto place = fall(residuals.signal, weight, border, std::hypot(seen, rest) / 2)) return *place;
  Values agreement;
  for (int k = 0; k < kStrips; ++k) agreement[k] = -on_plane[k];
  const float half_way = (inner(agreement) + outer(agreement)) / 2;
  return fall(agreement, weight, border, half_way).value_or(static_cast<float>(border));
}

double logResidual(double residual) { return std::log(std::max(residual, kSmallestResidual)); }

/// At the depth that suits a strip best.
double leastLogResidual(const std::array<float, EdgeProfile::kOffsets>& residual) {
  const auto i = std::min_element(residual.begin(), residual.end()) - residual.begin();
  double least = residual[i];
  if (i > 0 && i < EdgeProfile::kOffsets - 1) {  // the parabola through three samples
    const double slope = (residual[i + 1] - residual[i - 1]) / 2;
    const double curvature = residual[i + 1] - 2 * residual[i] + residual[i - 1];
    if (curvature > 0) least -= slope * slope / (2 * curvature);
  }
  return logResidual(least);
}

}  // namespace

EdgeStep findStep(const EdgeProfile::Residuals& residuals, const SideFace& side_face) {
  Values on_plane;
  Values inside;
  int n = 0;
  for (int k = 0; k < kStrips; ++k) {
    on_plane[k] = logResidual(residuals.residual[k][EdgeProfile::kOnPlane]);
    if (k < kStrips / 2 && residuals.weight[k] > 0) inside[n++] = on_plane[k];
  }
  EdgeStep step;
  if (n < kMinStrips) return step;
  std::nth_element(inside.begin(), inside.begin() + n / 2, inside.begin() + n);
  const float level = inside[n / 2];
  Values evidence;
  for (int k = 0; k < kStrips; ++k) {
    const double explained = std::min<double>(level, leastLogResidual(residuals.residual[k]));
    evidence[k] = std::clamp(static_cast<float>(on_plane[k] - explained), 0.F, kClear);
  }
  const int border = splitLevels(evidence, residuals.weight);
  if (border == 0) return step;
  const std::optional<int> face = sideFaceBegin(residuals, level, side_face);
  step.face = face.has_value();
  step.offset = EdgeProfile::offset(face ? *face : placeOfEdge(on_plane, residuals, border));
  step.inside = mean(on_plane, residuals.weight, border - kBlur - kLevel, border - kBlur);
  step.contrast = mean(on_plane, residuals.weight, border, kStrips) - step.inside;
  return step;
}

}  // namespace cabinet_articulation::core
