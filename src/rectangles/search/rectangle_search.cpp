// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/search/rectangle_search.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kRowShare = 0.25;  ///< of a step: rows between those that are looked at
constexpr double kMaxRowStep = 8;   ///< [px] ours: the smallest drawers are some 60 px high
constexpr int kMaxSweeps = 20;      ///< per step length; a guard, some five are usual

using Move = void (*)(PlaneRectangle& rectangle, double distance);

constexpr Move kMoves[] = {
    [](PlaneRectangle& r, double distance) { r.moveEdge(kEdges[0], distance); },
    [](PlaneRectangle& r, double distance) { r.moveEdge(kEdges[1], distance); },
    [](PlaneRectangle& r, double distance) { r.moveEdge(kEdges[2], distance); },
    [](PlaneRectangle& r, double distance) { r.moveEdge(kEdges.back(), distance); },
    [](PlaneRectangle& r, double distance) { r.angle += 2 * distance / std::hypot(r.width, r.height); },
    [](PlaneRectangle& r, double distance) { r.center += distance * r.xAxis(); },
    [](PlaneRectangle& r, double distance) { r.center += distance * r.yAxis(); },
};

class GreedySearch {
 public:
  GreedySearch(const PlaneChart& chart, const RectangleObjective& objective, const RectanglesConfig& config)
      : chart_(chart), objective_(objective), config_(config) {}

  SearchResult run(const PlaneRectangle& start, SearchFreedom freedom) {
    best_.rectangle = start;
    const double pixels_per_metre = chart_.pixelsPerMetre();
    for (double step = config_.first_step; step >= config_.last_step; step /= 2) {
      lookAtRows(static_cast<int>(std::clamp(step * pixels_per_metre * kRowShare, 1.0, kMaxRowStep)));
      climb(step, freedom);
    }
    lookAtRows(1);
    return best_;
  }

 private:
  /// Gains of different row steps do not compare.
  void lookAtRows(int row_step) {
    if (row_step == row_step_) return;
    row_step_ = row_step;
    best_.gain = gain(best_.rectangle);
  }

  /// In turn, until every move has failed since the last that gained.
  void climb(double step, SearchFreedom freedom) {
    const Move* const first = std::begin(kMoves) + (freedom == SearchFreedom::kAll ? 0 : std::size(kEdges));
    const auto all = std::end(kMoves) - first;
    std::ptrdiff_t failed = 0;
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep)
      for (const Move* move = first; move != std::end(kMoves); ++move) {
        failed = eitherWay(step, *move) ? 0 : failed + 1;
        if (failed == all) return;
      }
  }

  bool eitherWay(double step, Move move) {
    for (const double distance : {step, -step}) {
      PlaneRectangle candidate = best_.rectangle;
      move(candidate, distance);
      if (candidate.width < config_.min_side / 2 || candidate.height < config_.min_side / 2) continue;
      if (std::max(candidate.width, candidate.height) > 2 * config_.max_side) continue;
      const double candidate_gain = gain(candidate);
      if (!(candidate_gain > best_.gain)) continue;
      best_ = {candidate, candidate_gain};
      return true;
    }
    return false;
  }

  double gain(const PlaneRectangle& rectangle) const {
    const std::optional<ImageQuad> quad = chart_.project(rectangle);
    return quad ? objective_.gain(*quad, row_step_) : -std::numeric_limits<double>::infinity();
  }

  const PlaneChart& chart_;
  const RectangleObjective& objective_;
  const RectanglesConfig& config_;
  int row_step_ = 0;  ///< of the best gain
  SearchResult best_;
};

}  // namespace

SearchResult searchRectangle(const PlaneChart& chart, const RectangleObjective& objective, const PlaneRectangle& start,
                             SearchFreedom freedom, const RectanglesConfig& config) {
  return GreedySearch(chart, objective, config).run(start, freedom);
}

}  // namespace cabinet_articulation::core
