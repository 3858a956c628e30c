// SPDX-License-Identifier: BSD-3-Clause
#include "planes/fold_search.h"

#include <algorithm>
#include <cmath>

#include "geometry/degrees.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kStep = 2;         ///< [cells] between samples: block matching makes neighbours alike
constexpr int kDirections = 12;  ///< of lines that are tried; what is between them is left to the improvement
constexpr int kImprovements = 8;
constexpr double kLeastPart = 2500;       ///< [px] a smaller part has its plane from noise
constexpr double kIndependent = 15 * 15;  ///< [px] a window of block matching, within which noise is one and the same
constexpr double kSignificance = 100;     ///< gain in squares over their variance; chance gives 4, for four more unknowns
constexpr double kStandsOut =
    0.3;  ///< [px] that planes stand apart at least (ours): twice what calibrations of pairs bend them by

constexpr int kSamplePixels = kStep * kCell * kStep * kCell;
constexpr int kLeastSamples = static_cast<int>(kLeastPart) / kSamplePixels;

DisparityPlane sum(const DisparityPlane& p, const DisparityPlane& q) { return {p.a + q.a, p.b + q.b, p.c + q.c}; }

}  // namespace

std::optional<Fold> FoldSearch::process(const cv::Mat1f& cells, const GrownRegion& region, const RegionSet& set,
                                        double may_bend) {
  if (region.cells * kCell * kCell < 2 * kLeastPart) return std::nullopt;
  fillBlocks(cells, region, set);
  PlaneFit all;
  for (const int block : filled_) all.add(blocks_[block]);
  const auto flat = all.solve();
  const std::optional<Halves> start = bestLine();
  if (!flat || !start) return std::nullopt;
  std::optional<Halves> halves = improve(*start);
  const std::optional<Halves> swapped = improve(*solve(start->second, start->first));
  if (swapped && (!halves || swapped->squares < halves->squares)) halves = swapped;
  if (!halves || !(apart(halves->fold) > std::hypot(kStandsOut, may_bend))) return std::nullopt;
  const double independent = all.count() * kSamplePixels / kIndependent;
  if (!((all.squares(*flat) - halves->squares) * independent > kSignificance * halves->squares)) return std::nullopt;
  Fold fold = halves->fold;
  markFirst(fold);
  fold.first = sum(fold.first, region.plane);
  fold.second = sum(fold.second, region.plane);
  return fold;
}

/// Blocks hold the residuals of the region's plane: small numbers, whose squares are well conditioned.
void FoldSearch::fillBlocks(const cv::Mat1f& cells, const GrownRegion& region, const RegionSet& set) {
  grid_ = {cells.cols / kBlock + 1, cells.rows / kBlock + 1};
  blocks_.assign(grid_.area(), PlaneFit());
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    if (run.row % kStep != 0) continue;
    const double v = run.row * kCell;
    for (int col = (run.begin + kStep - 1) / kStep * kStep; col < run.end; col += kStep) {
      const double u = col * kCell;
      blocks_[blockOf(run.row, col)].add(u, v, cells(run.row, col) - region.plane.at(u, v));
    }
  }
  filled_.clear();
  for (int block = 0; block < grid_.area(); ++block)
    if (blocks_[block].count() > 0) filled_.push_back(block);
}

std::optional<FoldSearch::Halves> FoldSearch::bestLine() {
  std::optional<Halves> best;
  for (int i = 0; i < kDirections; ++i) {
    const auto halves = bestLine(i * 180 * kDegree / kDirections);
    if (halves && (!best || halves->squares < best->squares)) best = halves;
  }
  return best;
}

/// The best of the lines across `angle`, one block apart.
std::optional<FoldSearch::Halves> FoldSearch::bestLine(double angle) {
  const double cos = std::cos(angle), sin = std::sin(angle);
  const int middle = grid_.width + grid_.height;
  bins_.assign(2 * middle, PlaneFit());
  for (const int block : filled_) {
    const int row = block / grid_.width, column = block % grid_.width;
    const double along = cos * column + sin * row;
    bins_[middle + static_cast<int>(std::floor(along))].add(blocks_[block]);
  }
  before_.assign(1, PlaneFit());
  for (const PlaneFit& bin : bins_) {
    before_.push_back(before_.back());
    before_.back().add(bin);
  }
  std::optional<Halves> best;
  PlaneFit after;
  for (int i = 2 * middle - 1; i > 0; --i) {
    if (bins_[i].count() == 0) continue;
    after.add(bins_[i]);
    const auto halves = solve(before_[i], after);
    if (halves && (!best || halves->squares < best->squares)) best = halves;
  }
  return best;
}

/// The second surface may reach around the first one, so that no line divides them: on the first one's side of the line
/// where they meet, each block goes to the plane that explains it better.
std::optional<FoldSearch::Halves> FoldSearch::improve(Halves halves) {
  for (int i = 0; i < kImprovements; ++i) {
    PlaneFit first, second;
    for (const int block : filled_) (isFirst(blocks_[block], halves.fold) ? first : second).add(blocks_[block]);
    const auto better = solve(first, second);
    if (!better) return std::nullopt;
    halves = *better;
  }
  return halves;
}

bool FoldSearch::isFirst(const PlaneFit& block, const Fold& fold) const {
  return fold.ahead(block.meanU(), block.meanV()) > 0 && block.squares(fold.first) < block.squares(fold.second);
}

std::optional<FoldSearch::Halves> FoldSearch::solve(const PlaneFit& first, const PlaneFit& second) {
  if (std::min(first.count(), second.count()) < kLeastSamples) return std::nullopt;
  const auto first_plane = first.solve(), second_plane = second.solve();
  if (!first_plane || !second_plane) return std::nullopt;
  Fold fold{*first_plane, *second_plane, 1};
  if (fold.ahead(first.meanU(), first.meanV()) < 0) fold.first_sign = -1;
  return Halves{first, second, fold, first.squares(*first_plane) + second.squares(*second_plane)};
}

/// [px] How far the surfaces reach away from each other, on that side of the line where they meet on which it is less.
double FoldSearch::apart(const Fold& fold) const {
  double most = 0, least = 0;
  for (const int block : filled_) {
    const double ahead = fold.ahead(blocks_[block].meanU(), blocks_[block].meanV());
    if (ahead < 0)
      least = std::min(least, ahead);
    else if (isFirst(blocks_[block], fold))
      most = std::max(most, ahead);
  }
  return std::min(most, -least);
}

void FoldSearch::markFirst(const Fold& fold) {
  near_first_.assign(blocks_.size(), 0);
  for (const int block : filled_) {
    if (!isFirst(blocks_[block], fold)) continue;
    const int row = block / grid_.width, col = block % grid_.width;
    for (int r = std::max(row - 1, 0); r < std::min(row + 2, grid_.height); ++r)
      for (int c = std::max(col - 1, 0); c < std::min(col + 2, grid_.width); ++c) near_first_[r * grid_.width + c] = 1;
  }
}

}  // namespace cabinet_articulation::core
