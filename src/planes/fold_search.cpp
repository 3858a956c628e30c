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
/// [px] that planes stand apart at least (ours): twice what calibrations of pairs bend them by
constexpr double kStandsOut = 0.3;
constexpr double kSure = 30;  ///< gain from chance once in three million; a thousand regions a second give that in an hour (ours)

constexpr int kSamplePixels = kStep * kCell * kStep * kCell;
constexpr int kLeastSamples = static_cast<int>(kLeastPart) / kSamplePixels;

DisparityPlane sum(const DisparityPlane& p, const DisparityPlane& q) { return {p.a + q.a, p.b + q.b, p.c + q.c}; }

}  // namespace

std::optional<Fold> FoldSearch::process(const cv::Mat1f& cells, const GrownRegion& region, const RegionSet& set,
                                        double may_bend) {
  if (region.cells * kCell * kCell < 2 * kLeastPart) return std::nullopt;
  fillBlocks(cells, region, set);
  const auto flat = all_.solve();
  const std::optional<Halves> line = bestLine();
  if (!flat || !line) return std::nullopt;
  flat_squares_ = all_.squares(*flat);
  std::optional<Fold> fold = foldNear(*line, may_bend);
  if (!fold) fold = stepAt(*line);
  if (!fold) return std::nullopt;
  markNear(kFirst, &near_first_);
  markNear(kSecond, &near_second_);
  fold->first = sum(fold->first, region.plane);
  fold->second = sum(fold->second, region.plane);
  return fold;
}

bool FoldSearch::mayBeFirst(const Fold& fold, int row, int col, double disparity) const {
  const double u = col * kCell, v = row * kCell;
  if (!fold.is_step) return fold.ahead(u, v) >= 0;
  const int block = blockOf(row, col);
  if (near_first_[block] == 0 || near_second_[block] == 0) return near_first_[block] != 0;
  return std::abs(fold.first.at(u, v) - disparity) < std::abs(fold.second.at(u, v) - disparity);
}

bool FoldSearch::mayBeSecond(const Fold& fold, int row, int col, double disparity) const {
  if (fold.is_step) return !mayBeFirst(fold, row, col, disparity);
  return near_first_[blockOf(row, col)] == 0 || fold.ahead(col * kCell, row * kCell) <= 0;
}

bool FoldSearch::isSignificant(const Halves& halves) const {
  const double independent = all_.count() * kSamplePixels / kIndependent;
  return (flat_squares_ - halves.squares) * independent > kSignificance * halves.squares;
}

std::optional<Fold> FoldSearch::foldNear(const Halves& line, double may_bend) {
  std::optional<Halves> halves = improve(line);
  const std::optional<Halves> swapped = improve(*solve(line.second, line.first));
  if (swapped && (!halves || swapped->squares < halves->squares)) halves = swapped;
  if (!halves || !(apart(halves->fold) > std::hypot(kStandsOut, may_bend)) || !isSignificant(*halves)) return std::nullopt;
  sides_.assign(blocks_.size(), kNone);
  for (const int block : filled_) sides_[block] = isFirst(blocks_[block], halves->fold) ? kFirst : kSecond;
  return halves->fold;
}

/// Fronts a step apart are parallel. The residuals of surfaces that are apart by less than twice their scatter have one peak,
/// not two (Eisenberger 1964).
std::optional<Fold> FoldSearch::stepAt(const Halves& line) {
  const std::optional<Halves> step = solveParallel(line);
  if (!step || !isSignificant(*step)) return std::nullopt;
  const double cos = std::cos(line.angle), sin = std::sin(line.angle);
  sides_.assign(blocks_.size(), kNone);
  for (const int block : filled_) sides_[block] = binOf(block, cos, sin) < line.bin ? kFirst : kSecond;
  const Jump jump = jumpAcross(step->fold);
  const double scatter = std::sqrt(std::max(step->first.squares(step->fold.first) / step->first.count(),
                                            step->second.squares(step->fold.second) / step->second.count()));
  if (!(jump.gain > kSure && jump.mean > std::max(kStandsOut / 2, 2 * scatter))) return std::nullopt;
  return step->fold;
}

std::optional<FoldSearch::Halves> FoldSearch::solveParallel(const Halves& line) {
  PlaneFit both = line.first.centred();
  both.add(line.second.centred());
  const auto slopes = both.solve();
  if (!slopes) return std::nullopt;
  const auto through = [&](const PlaneFit& part) {
    DisparityPlane plane = *slopes;
    plane.c += part.meanDisparity() - plane.at(part.meanU(), part.meanV());
    return plane;
  };
  Halves step = line;
  step.fold = {through(line.first), through(line.second)};
  step.fold.is_step = true;
  step.squares = both.squares(*slopes);
  return step;
}

/// Between blocks of which two others are in the middle: one of these holds the edge, as a rule.
FoldSearch::Jump FoldSearch::jumpAcross(const Fold& step) const {
  double sum = 0, squares = 0, rest = 0;
  int n = 0;
  for (const int from : filled_)
    for (const int next : {1, grid_.width}) {
      const int before = from + next, behind = before + next, to = behind + next;
      if (next == 1 && to / grid_.width != from / grid_.width) continue;  // beyond the row's end
      if (to >= static_cast<int>(blocks_.size()) || sides_[from] == kNone || sides_[to] == kNone) continue;
      if (sides_[from] != sides_[before] || sides_[before] == sides_[behind] || sides_[behind] != sides_[to]) continue;
      const bool forward = sides_[from] == kFirst;
      const PlaneFit &first = blocks_[forward ? from : to], &second = blocks_[forward ? to : from];
      const double jump = first.meanDisparity() - second.meanDisparity();
      const double expected = step.first.at(first.meanU(), first.meanV()) - step.second.at(second.meanU(), second.meanV());
      sum += jump;
      squares += jump * jump;
      rest += (jump - expected) * (jump - expected);
      ++n;
    }
  if (n == 0) return {};
  return {std::abs(sum) / n, n * std::log(squares / rest)};
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
  all_ = PlaneFit();
  for (int block = 0; block < grid_.area(); ++block) {
    if (blocks_[block].count() == 0) continue;
    filled_.push_back(block);
    all_.add(blocks_[block]);
  }
}

int FoldSearch::binOf(int block, double cos, double sin) const {
  const int row = block / grid_.width, column = block % grid_.width;
  return grid_.width + grid_.height + static_cast<int>(std::floor(cos * column + sin * row));
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
  bins_.assign(2 * (grid_.width + grid_.height), PlaneFit());
  for (const int block : filled_) bins_[binOf(block, cos, sin)].add(blocks_[block]);
  before_.assign(1, PlaneFit());
  for (const PlaneFit& bin : bins_) {
    before_.push_back(before_.back());
    before_.back().add(bin);
  }
  std::optional<Halves> best;
  PlaneFit after;
  for (int i = static_cast<int>(bins_.size()) - 1; i > 0; --i) {
    if (bins_[i].count() == 0) continue;
    after.add(bins_[i]);
    const auto halves = solve(before_[i], after);
    if (!halves || (best && !(halves->squares < best->squares))) continue;
    best = halves;
    best->angle = angle;
    best->bin = i;
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

/// The blocks of a side and their neighbours.
void FoldSearch::markNear(Side side, std::vector<std::uint8_t>* near) const {
  near->assign(blocks_.size(), 0);
  for (const int block : filled_) {
    if (sides_[block] != side) continue;
    const int row = block / grid_.width, col = block % grid_.width;
    for (int r = std::max(row - 1, 0); r < std::min(row + 2, grid_.height); ++r)
      for (int c = std::max(col - 1, 0); c < std::min(col + 2, grid_.width); ++c) (*near)[r * grid_.width + c] = 1;
  }
}

}  // namespace cabinet_articulation::core
