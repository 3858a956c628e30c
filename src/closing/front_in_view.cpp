// SPDX-License-Identifier: BSD-3-Clause
#include "closing/front_in_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace cabinet_articulation::core {
namespace {

constexpr double kGap = 0.015;    ///< [m] on both sides of an edge: gaps, and windows that blend both sides (measured: 1 cm)
constexpr double kBeside = 0.1;   ///< [m] how far beyond an edge neighbours are looked for: narrower ones are rare (ours)
constexpr double kGrazing = 0.2;  ///< sine of the least angle to the view at which depth tells of a surface (ours: 12 degrees)
constexpr int kLeastCells = 3;    ///< beside an edge; fewer say nothing
// Ours: a front has a neighbour beside half of its sides. Elsewhere a surface hardly ever goes on in the plane of an open front.
constexpr double kGoesOn = 2.3;  ///< [nats] ln(0.5 / 0.05)
constexpr double kEnds = -0.64;  ///< [nats] ln(0.5 / 0.95)

/// Cells whose rays may hit the front or what is beside it.
cv::Rect cellsNear(const DepthView& view, const Rectangle& front) {
  const cv::Rect all(0, 0, view.columns, view.rows);
  Rectangle grown = front;
  grown.width += 2 * kBeside;
  grown.height += 2 * kBeside;
  const Eigen::Isometry3d T_camera_fixed = view.T_fixed_camera.inverse();
  double left = view.columns, right = 0, top = view.rows, bottom = 0;
  for (const Eigen::Vector3d& corner : grown.corners()) {
    const Eigen::Vector3d p = T_camera_fixed * corner;
    if (p.z() < kBeside) return all;
    const double u = view.fx * p.x() / p.z() + view.cx, v = view.fy * p.y() / p.z() + view.cy;
    left = std::min(left, u);
    right = std::max(right, u);
    top = std::min(top, v);
    bottom = std::max(bottom, v);
  }
  const auto cell = [](double value, int end) { return static_cast<int>(std::clamp(std::floor(value), 0.0, 1.0 * end)); };
  const cv::Point first(cell(left, view.columns), cell(top, view.rows));
  return cv::Rect(first, cv::Point(cell(right + 1, view.columns), cell(bottom + 1, view.rows))) & all;
}

constexpr std::size_t kInside = kSides;  ///< the part that is no side's

/// The side that a point of the front's plane is beside, or kInside.
std::optional<std::size_t> partAt(double x, double y, const Rectangle& front) {
  const double beyond_x = std::abs(x) - front.width / 2, beyond_y = std::abs(y) - front.height / 2;
  if (beyond_x < -kGap && beyond_y < -kGap) return kInside;
  if (std::min(beyond_x, beyond_y) > 0 || std::max(beyond_x, beyond_y) < kGap) return std::nullopt;
  if (std::max(beyond_x, beyond_y) > kBeside) return std::nullopt;
  const bool across = beyond_x > beyond_y;
  const std::size_t edge = across ? (x < 0 ? kEdgeMinusX : kEdgePlusX) : (y < 0 ? kEdgeMinusY : kEdgePlusY);
  return 2 * edge + ((across ? y : x) < 0 ? 0 : 1);
}

enum class Cells : std::uint8_t { kMeasured, kAll };

/// Calls `use(part, depth, point)` for every `step`-th cell, with the measured point in the front's frame.
template <Cells kWhich, class Use>
void forEachPoint(const DepthView& view, const Rectangle& front, int step, Use&& use) {
  const Eigen::Isometry3d T_front_camera = front.pose.inverse() * view.T_fixed_camera;
  const Eigen::Vector3d eye = T_front_camera.translation();
  if (eye.z() <= 0) return;
  const cv::Rect cells = cellsNear(view, front);
  for (int row = cells.y; row < cells.br().y; row += step)
    for (int column = cells.x; column < cells.br().x; column += step) {
      const float depth = view.at(column, row);
      if (kWhich == Cells::kMeasured && !(depth > 0)) continue;
      const Eigen::Vector3d ray = T_front_camera.linear() * view.ray(column, row);
      if (-ray.z() < kGrazing * ray.norm()) continue;
      const Eigen::Vector3d hit = eye - ray * (eye.z() / ray.z());
      const std::optional<std::size_t> part = partAt(hit.x(), hit.y(), front);
      if (part) use(*part, depth, Eigen::Vector3d(eye + depth * ray));
    }
}

/// True if the point is in the plane.
bool count(const Eigen::Vector3d& point, double band, CellCount* cells) {
  const bool before = point.z() > band, behind = point.z() < -band;
  ++(before ? cells->before : behind ? cells->behind : cells->in_plane);
  return !before && !behind;
}

}  // namespace

FrontInView look(const DepthView& view, const Rectangle& front, double band) {
  FrontInView result;
  forEachPoint<Cells::kAll>(view, front, 1, [&](std::size_t part, float depth, const Eigen::Vector3d& point) {
    const bool inside = part == kInside;
    CellCount& cells = inside ? result.inside : result.beside[part];
    if (!(depth > 0))
      ++cells.blind;
    else if (count(point, band, &cells))
      (inside ? result.front : result.around[part]).push_back(point);
  });
  return result;
}

CellsBeside lookBeside(const DepthView& view, const Rectangle& front, double band, int step) {
  CellsBeside beside;
  forEachPoint<Cells::kMeasured>(view, front, step, [&](std::size_t part, float, const Eigen::Vector3d& point) {
    if (part != kInside) count(point, band, &beside[part]);
  });
  return beside;
}

bool goesOn(const CellCount& beside) { return beside.seen() >= kLeastCells && 2 * beside.in_plane > beside.seen(); }

bool isBetweenSurfaces(const CellsBeside& beside) {
  const auto goes_on = [&beside](std::size_t edge) {
    const CellCount &first = beside[2 * edge], &second = beside[2 * edge + 1];
    const int in_plane = first.in_plane + second.in_plane;
    return in_plane >= kLeastCells && 2 * in_plane > first.all() + second.all();
  };
  return (goes_on(kEdgeMinusX) && goes_on(kEdgePlusX)) || (goes_on(kEdgeMinusY) && goes_on(kEdgePlusY));
}

void OwnEdges::add(const CellsBeside& beside, const CellCount& inside) {
  in_plane_ += inside.in_plane;
  behind_ += inside.behind;
  for (std::size_t side = 0; side < kSides; ++side) {
    if (beside[side].seen() < kLeastCells) continue;
    ++seen_[side];
    if (goesOn(beside[side])) ++along_[side];
  }
}

double surfaceLogOdds(const CellsBeside& seen) {
  double log_odds = 0;
  for (const CellCount& side : seen) {
    if (side.seen() < kLeastCells) continue;
    log_odds += kEnds + (kGoesOn - kEnds) * side.in_plane / side.seen();
  }
  return log_odds;
}

void keepBest(const CellsBeside& seen, const OwnEdges& edges, CellsBeside* best) {
  for (std::size_t side = 0; side < seen.size(); ++side) {
    CellCount& kept = (*best)[side];
    if (seen[side].seen() < kLeastCells || !edges.isEdge(side)) continue;
    // Compared as fractions, without division.
    if (kept.seen() == 0 || seen[side].in_plane * kept.seen() > kept.in_plane * seen[side].seen()) kept = seen[side];
  }
}

}  // namespace cabinet_articulation::core
