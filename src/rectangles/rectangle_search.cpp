// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/rectangle_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rectangles/image_edge.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kRowShare = 0.25;  ///< of a step: rows between those that are looked at
constexpr double kMaxRowStep = 8;   ///< [px] ours: the smallest drawers are some 60 px high
constexpr int kMaxSweeps = 20;      ///< per step length; a guard, some five are usual

class GreedySearch {
 public:
  GreedySearch(const PlaneChart& chart, const RectangleObjective& objective, const RectanglesConfig& config)
      : chart_(chart), objective_(objective), config_(config) {}

  SearchResult run(const PlaneRectangle& start, SearchFreedom freedom) {
    best_.rectangle = start;
    const double pixels_per_metre = chart_.pixelsPerMetre();
    for (double step = config_.first_step; step >= config_.last_step; step /= 2) {
      row_step_ = static_cast<int>(std::clamp(step * pixels_per_metre * kRowShare, 1.0, kMaxRowStep));
      best_.gain = gain(best_.rectangle);
      for (int sweep = 0; sweep < kMaxSweeps && improve(step, freedom); ++sweep) continue;
    }
    row_step_ = 1;
    best_.gain = gain(best_.rectangle);
    return best_;
  }

 private:
  /// One sweep over all moves; true if any of them gained.
  bool improve(double step, SearchFreedom freedom) {
    bool improved = false;
    if (freedom == SearchFreedom::kAll)
      for (const Edge edge : kEdges)
        improved |= eitherWay(step, [edge](PlaneRectangle& r, double distance) { r.moveEdge(edge, distance); });
    improved |=
        eitherWay(step, [](PlaneRectangle& r, double distance) { r.angle += 2 * distance / std::hypot(r.width, r.height); });
    improved |= eitherWay(step, [](PlaneRectangle& r, double distance) { r.center += distance * r.xAxis(); });
    improved |= eitherWay(step, [](PlaneRectangle& r, double distance) { r.center += distance * r.yAxis(); });
    return improved;
  }

  template <class Move>
  bool eitherWay(double step, Move&& move) {
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
  int row_step_ = 1;
  SearchResult best_;
};

}  // namespace

SearchResult searchRectangle(const PlaneChart& chart, const RectangleObjective& objective, const PlaneRectangle& start,
                             SearchFreedom freedom, const RectanglesConfig& config) {
  return GreedySearch(chart, objective, config).run(start, freedom);
}

}  // namespace cabinet_articulation::core
