// SPDX-License-Identifier: BSD-3-Clause
#include "planes/region_competition.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cabinet_articulation::core {
namespace {

constexpr float kNoLimit = std::numeric_limits<float>::max();  ///< [px]

__attribute__((target_clones("avx2", "default"))) void competeRow(const float* disparity, int begin, int end, float slope,
                                                                  float start, float margin, float* limit) {
  for (int u = begin; u < end; ++u) {
    const float residual = disparity[u] - (slope * static_cast<float>(u) + start);
    limit[u] = std::min(limit[u], std::abs(residual) + margin);
  }
}

}  // namespace

RegionCompetition::RegionCompetition(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

const cv::Mat1f& RegionCompetition::process(const cv::Mat1f& disparity, const RegionSet& set) {
  compete(disparity, 1, set, &limit_);
  return limit_;
}

const cv::Mat1f& RegionCompetition::processCells(const cv::Mat1f& cells, const RegionSet& set) {
  compete(cells, kCell, set, &cell_limit_);
  return cell_limit_;
}

/// Neighbouring values are `spacing` pixels apart.
void RegionCompetition::compete(const cv::Mat1f& values, int spacing, const RegionSet& set, cv::Mat1f* limit) const {
  const int per_cell = kCell / spacing;
  limit->create(values.size());
  for (int row = 0; row < limit->rows; ++row) std::fill_n((*limit)[row], limit->cols, kNoLimit);
  const float margin = static_cast<float>(config_.other_plane_margin);
  for (const GrownRegion& region : set.regions)
    for (int i = region.first_run; i < region.last_run; ++i) {
      const CellRun& run = set.runs[i];
      for (int row = run.row * per_cell; row < (run.row + 1) * per_cell; ++row)
        competeRow(values[row], run.begin * per_cell, run.end * per_cell, static_cast<float>(region.plane.a * spacing),
                   static_cast<float>(region.plane.at(0, row * spacing)), margin, (*limit)[row]);
    }
}

}  // namespace cabinet_articulation::core
