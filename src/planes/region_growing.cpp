// SPDX-License-Identifier: BSD-3-Clause
#include "planes/region_growing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/cell_erosion.h"
#include "planes/disparity_tolerance.h"
#include "planes/fold_search.h"
#include "planes/plane_fit.h"

namespace cabinet_articulation::core {
namespace {

/// Farther from every plane than any limit, so that the row loops need no second test.
constexpr float kNoDisparity = -std::numeric_limits<float>::infinity();

__attribute__((target_clones("avx2", "default"))) void markRow(const float* disparity, int n, float slope, float start,
                                                               DisparityTolerance tolerance, std::uint8_t* out) {
  for (int i = 0; i < n; ++i)
    out[i] = std::abs(slope * static_cast<float>(i) + start - disparity[i]) <= tolerance.at(disparity[i]) ? 255 : 0;
}

__attribute__((target_clones("avx2", "default"))) void shrinkRows(const float* upper, const float* lower, int n, float* out) {
  for (int i = 0; i < n; ++i) {
    float value = kNoDisparity;
    for (const float pixel : {lower[kCell * i + 1], lower[kCell * i], upper[kCell * i + 1], upper[kCell * i]})
      value = isValidDisparity(pixel) ? pixel : value;
    out[i] = value;
  }
}

/// As setTo(), which takes memory from the heap.
void clearRows(const cv::Range& rows, cv::Mat1b* cells) {
  for (int row = rows.start; row < rows.end; ++row) std::fill_n((*cells)[row], cells->cols, 0);
}

/// Marks the cells [begin, end) of a row whose residual is within `limit`.
__attribute__((target_clones("avx2", "default"))) void markWithin(const float* __restrict disparity,
                                                                  const float* __restrict limit, int begin, int end,
                                                                  DisparityPlane plane, int v, std::uint8_t* __restrict out) {
  for (int col = begin; col < end; ++col) {
    const double residual = plane.at(col * kCell, v) - disparity[col];
    out[col] = std::abs(residual) <= limit[col] ? 255 : 0;
  }
}

}  // namespace

RegionGrowing::RegionGrowing(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

RegionSet& RegionGrowing::process(const DepthFrame& frame, const std::vector<DisparityPlane>& planes) {
  set_.regions.clear();
  set_.runs.clear();
  shrinkDisparity(frame.disparity);
  if (disparity_.empty()) return set_;
  for (const DisparityPlane& plane : planes) {
    markInPlane(plane, frame.camera);
    addComponents(plane, {0, in_plane_.rows});
  }
  return set_;
}

RegionSet& RegionGrowing::trim(const cv::Mat1f& limit) {
  std::swap(set_, untrimmed_);
  set_.regions.clear();
  set_.runs.clear();
  clearRows({0, in_plane_.rows}, &in_plane_);
  for (const GrownRegion& region : untrimmed_.regions) {
    for (int i = region.first_run; i < region.last_run; ++i) {
      const CellRun& run = untrimmed_.runs[i];
      markWithin(disparity_[run.row], limit[run.row], run.begin, run.end, region.plane, run.row * kCell, in_plane_[run.row]);
    }
    const cv::Range rows(untrimmed_.runs[region.first_run].row, untrimmed_.runs[region.last_run - 1].row + 1);
    addComponents(region.plane, rows);
    clearRows(rows, &in_plane_);
  }
  return set_;
}

RegionSet& RegionGrowing::unfold(const StereoCamera& camera, double may_bend, FoldSearch* search) {
  const int n = static_cast<int>(set_.regions.size());
  for (int i = 0; i < n; ++i) {
    const GrownRegion bent = set_.regions[i];
    const auto fold = search->process(disparity_, bent, set_, may_bend);
    if (!fold) continue;
    markInPlane(fold->first, camera);
    clear(bent, [&](int row, int col) { return !search->mayBeFirst(*fold, row, col, disparity_(row, col)); });
    addPart(bent, fold->first);
    markInPlane(fold->second, camera);
    clear(bent, [&](int row, int col) { return !search->mayBeSecond(*fold, row, col, disparity_(row, col)); });
    addPart(bent, fold->second);
    set_.regions[i].cells = 0;
  }
  auto& regions = set_.regions;
  regions.erase(std::remove_if(regions.begin(), regions.end(), [](const GrownRegion& region) { return region.cells == 0; }),
                regions.end());
  return set_;
}

/// Unmarks the cells of `region` for which `out` holds.
template <class Predicate>
void RegionGrowing::clear(const GrownRegion& region, const Predicate& out) {
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set_.runs[i];
    for (int col = run.begin; col < run.end; ++col)
      if (out(run.row, col)) in_plane_(run.row, col) = 0;
  }
}

/// Among the cells marked, the connected region that has most of `whole`: there may be larger ones elsewhere in its plane.
void RegionGrowing::addPart(const GrownRegion& whole, const DisparityPlane& plane) {
  const cv::Range rows(0, in_plane_.rows);
  erode(in_plane_, rows, &eroded_);
  cores_.process(eroded_, rows);
  grown_.create(in_plane_.size());
  clearRows(rows, &grown_);
  for (int i = whole.first_run; i < whole.last_run; ++i) {
    const CellRun& run = set_.runs[i];
    std::fill(grown_[run.row] + run.begin, grown_[run.row] + run.end, 255);
  }
  const ConnectedRuns::Component* part = nullptr;
  std::ptrdiff_t most = 0;
  for (const ConnectedRuns::Component& core : cores_.components()) {
    std::ptrdiff_t shared = 0;
    for (int i = core.first_run; i < core.last_run; ++i) {
      const CellRun& run = cores_.runs()[i];
      shared += std::count(grown_[run.row] + run.begin, grown_[run.row] + run.end, 255);
    }
    if (shared <= most) continue;
    most = shared;
    part = &core;
  }
  if (!part || part->cells * kCell * kCell < config_.min_region) return;
  set_.regions.push_back(growBack(*part));
  set_.regions.back().plane = fitPlane(*part).value_or(plane);
}

/// The connected regions among the cells marked, which lie in these rows.
void RegionGrowing::addComponents(const DisparityPlane& plane, const cv::Range& rows) {
  erode(in_plane_, rows, &eroded_);
  cores_.process(eroded_, rows);
  for (const ConnectedRuns::Component& core : cores_.components()) {
    if (core.cells * kCell * kCell < config_.min_region) continue;
    set_.regions.push_back(growBack(core));
    set_.regions.back().plane = fitPlane(core).value_or(plane);
  }
}

void RegionGrowing::shrinkDisparity(const cv::Mat1f& disparity) {
  disparity_.create(disparity.rows / kCell, disparity.cols / kCell);
  for (int row = 0; row < disparity_.rows; ++row)
    shrinkRows(disparity[row * kCell], disparity[row * kCell + 1], disparity_.cols, disparity_[row]);
}

void RegionGrowing::markInPlane(const DisparityPlane& plane, const StereoCamera& camera) {
  const DisparityTolerance tolerance(camera, config_.region_tolerance_px, config_.region_tolerance_m, config_.tolerance_cap);
  in_plane_.create(disparity_.size());
  for (int row = 0; row < disparity_.rows; ++row)
    markRow(disparity_[row], disparity_.cols, static_cast<float>(plane.a * kCell), static_cast<float>(plane.at(0, row * kCell)),
            tolerance, in_plane_[row]);
}

/// Only the core: at the edges block matching blends two surfaces.
std::optional<DisparityPlane> RegionGrowing::fitPlane(const ConnectedRuns::Component& core) const {
  PlaneFit fit;
  for (int i = core.first_run; i < core.last_run; ++i) {
    const CellRun& run = cores_.runs()[i];
    for (int col = run.begin; col < run.end; ++col) fit.add(col * kCell, run.row * kCell, disparity_(run.row, col));
  }
  return fit.solve();
}

/// What the erosion took comes back, so that the region reaches to its edges.
GrownRegion RegionGrowing::growBack(const ConnectedRuns::Component& core) {
  grown_.create(in_plane_.size());
  const int top = std::max(cores_.runs()[core.first_run].row - 1, 0);
  const int bottom = std::min(cores_.runs()[core.last_run - 1].row + 2, grown_.rows);
  clearRows({top, bottom}, &grown_);
  for (int i = core.first_run; i < core.last_run; ++i) {
    const CellRun& run = cores_.runs()[i];
    const int begin = std::max(run.begin - 1, 0), end = std::min(run.end + 1, grown_.cols);
    for (int row = std::max(run.row - 1, top); row < std::min(run.row + 2, bottom); ++row)
      std::copy(in_plane_[row] + begin, in_plane_[row] + end, grown_[row] + begin);
  }
  GrownRegion region;
  region.first_run = static_cast<int>(set_.runs.size());
  for (int row = top; row < bottom; ++row) appendRuns(grown_[row], grown_.cols, row, &set_.runs);
  region.last_run = static_cast<int>(set_.runs.size());
  for (int i = region.first_run; i < region.last_run; ++i) region.cells += set_.runs[i].end - set_.runs[i].begin;
  return region;
}

}  // namespace cabinet_articulation::core
