// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/acceptance/rectangle_acceptance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kWellSeen = 0.6;       ///< share of each edge in view where the image cuts others (ours)
constexpr double kSameOverlap = 0.5;    ///< IoU; two fits of one surface share more
constexpr double kSameDistance = 0.03;  ///< [m] along the normal
constexpr double kSameNormal = 0.94;    ///< cos 20 deg; planes of small fronts tilt by several degrees

}  // namespace

double precision(const LabelCounts& counts, const RectanglesConfig& config) {
  if (counts.total() == 0) return 0;
  const double agreeing =
      counts.in_plane + (1 - config.cost_occluded) * counts.occluded + (1 - config.cost_unknown) * counts.unknown;
  return agreeing / counts.total();
}

double recall(const LabelCounts& counts, int region_inliers) {
  return region_inliers > 0 ? std::min(1.0, static_cast<double>(counts.in_plane) / region_inliers) : 0;
}

bool fillsRegion(const DetectedRectangle& rectangle, const LabelCounts& counts, const RectanglesConfig& config) {
  const auto [shorter, longer] = std::minmax(rectangle.rectangle.width, rectangle.rectangle.height);
  return shorter >= config.min_side && longer <= config.max_side && rectangle.precision > config.min_precision &&
         rectangle.recall > config.min_recall && counts.in_plane >= config.min_visible * counts.total();
}

bool bounded(const std::array<float, 4>& edge_support, const std::array<bool, 4>& cut, const RectanglesConfig& config) {
  const float across_x = std::max(edge_support[kEdgeMinusX], edge_support[kEdgePlusX]);
  const float across_y = std::max(edge_support[kEdgeMinusY], edge_support[kEdgePlusY]);
  const float sum = std::accumulate(edge_support.begin(), edge_support.end(), 0.F);
  if (sum >= config.min_observed_edges && std::min(across_x, across_y) >= config.min_observed_across) return true;
  const bool is_cut = std::count(cut.begin(), cut.end(), true) > 0;
  const bool opposite = (!cut[kEdgeMinusX] && !cut[kEdgePlusX]) || (!cut[kEdgeMinusY] && !cut[kEdgePlusY]);
  if (!is_cut || !opposite) return false;
  return std::all_of(kEdges.begin(), kEdges.end(), [&](Edge edge) { return cut[edge] || edge_support[edge] >= kWellSeen; });
}

bool mayBeBounded(float observed_edges, const RectanglesConfig& config) {
  return observed_edges >= std::min<double>(config.min_observed_edges / 2, 2 * kWellSeen);  // two edges of a cut front
}

bool framed(const DetectedRectangle& rectangle, const RectanglesConfig& config) {
  const auto seen = [&](float share) { return share >= config.min_observed_across; };
  const auto& edges = rectangle.edge_support;
  return !rectangle.hollow || std::count_if(edges.begin(), edges.end(), seen) > 2;
}

bool sameSurface(const Rectangle& a, const Rectangle& b) {
  return a.normal().dot(b.normal()) > kSameNormal && std::abs(a.plane().distance(b.center())) < kSameDistance &&
         intersectionOverUnion(a, b) > kSameOverlap;
}

std::vector<DetectedRectangle> selectBest(const std::vector<SupportedRectangle>& candidates, const RectanglesConfig& config) {
  std::vector<const SupportedRectangle*> distinct(candidates.size());
  std::transform(candidates.begin(), candidates.end(), distinct.begin(), [](const SupportedRectangle& c) { return &c; });
  std::sort(distinct.begin(), distinct.end(), [](const SupportedRectangle* a, const SupportedRectangle* b) {
    return a->support != b->support ? a->support > b->support : a < b;
  });
  auto end = distinct.begin();
  for (const SupportedRectangle* candidate : distinct)
    if (std::none_of(distinct.begin(), end, [&](const SupportedRectangle* better) {
          return sameSurface(better->detection.rectangle, candidate->detection.rectangle);
        }))
      *end++ = candidate;
  distinct.erase(end, distinct.end());
  const auto tracked =
      static_cast<int>(std::count_if(distinct.begin(), distinct.end(), [](const SupportedRectangle* c) { return c->tracked; }));
  std::vector<DetectedRectangle> selected;
  selected.reserve(std::min<size_t>(distinct.size(), config.max_rectangles));
  int others = std::max(config.max_rectangles - tracked, 0);
  for (const SupportedRectangle* candidate : distinct) {
    if (static_cast<int>(selected.size()) == config.max_rectangles) break;
    if (candidate->tracked || others-- > 0) selected.push_back(candidate->detection);
  }
  return selected;
}

}  // namespace cabinet_articulation::core
