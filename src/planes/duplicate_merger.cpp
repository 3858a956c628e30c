// SPDX-License-Identifier: BSD-3-Clause
#include "planes/duplicate_merger.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr double kAgreement = 0.6;  ///< share of the tolerance: a door ajar differs by more from its neighbour

/// [px] between a region's plane and another one, over all cells: what is shared lies where they cross.
double meanDifference(const DisparityPlane& other, const GrownRegion& region, const RegionSet& set) {
  double sum = 0;
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    const double v = run.row * kCell;
    for (int col = run.begin; col < run.end; ++col) sum += std::abs(other.at(col * kCell, v) - region.plane.at(col * kCell, v));
  }
  return sum / region.cells;
}

}  // namespace

void DuplicateMerger::process(cv::Size image, RegionSet* set) {
  // A stable sort takes memory.
  std::sort(set->regions.begin(), set->regions.end(), [](const GrownRegion& a, const GrownRegion& b) {
    return a.cells != b.cells ? a.cells > b.cells : a.first_run < b.first_run;
  });
  owner_.create(image.height / kCell, image.width / kCell);
  for (int row = 0; row < owner_.rows; ++row) std::fill_n(owner_[row], owner_.cols, -1);
  kept_.clear();
  for (const GrownRegion& region : set->regions) {
    if (static_cast<int>(kept_.size()) == config_.max_regions) break;
    if (isDuplicate(region, *set)) continue;
    const int index = static_cast<int>(kept_.size());
    for (int i = region.first_run; i < region.last_run; ++i) {
      const CellRun& run = set->runs[i];
      int* const owner = owner_[run.row];
      for (int col = run.begin; col < run.end; ++col) owner[col] = owner[col] < 0 ? index : owner[col];
    }
    kept_.push_back(region);
  }
  set->regions = kept_;
}

bool DuplicateMerger::isDuplicate(const GrownRegion& region, const RegionSet& set) {
  shared_.assign(kept_.size(), 0);
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    const int* const owner = owner_[run.row];
    // Neighbours have one owner mostly; counting each in memory would wait for the one before.
    for (int col = run.begin, end = col; col < run.end; col = end) {
      while (end < run.end && owner[end] == owner[col]) ++end;
      if (owner[col] >= 0) shared_[owner[col]] += end - col;
    }
  }
  for (size_t k = 0; k < kept_.size(); ++k)
    if (shared_[k] >= config_.duplicate_overlap * region.cells &&
        meanDifference(kept_[k].plane, region, set) <= kAgreement * config_.region_tolerance_px)
      return true;
  return false;
}

}  // namespace cabinet_articulation::core
