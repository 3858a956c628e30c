// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/region_growing.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/disparity_tolerance.h"
#include "cabinet_articulation/planes/plane_fit.h"

namespace cabinet_articulation::core {
namespace {

constexpr float kNoDisparity = -1e6F;  ///< far from every plane, so that the row loop needs no second test

__attribute__((target_clones("avx2", "default"))) void markRow(const float* disparity, int n, float slope, float start,
                                                               DisparityTolerance tolerance, std::uint8_t* out) {
  for (int i = 0; i < n; ++i) out[i] = std::abs(slope * i + start - disparity[i]) <= tolerance.at(disparity[i]) ? 255 : 0;
}

}  // namespace

RegionGrowing::RegionGrowing(const PlanesConfig& config) : config_(config) { checkConfig(config_); }

RegionSet& RegionGrowing::process(const DepthFrame& frame, const std::vector<DisparityPlane>& planes) {
  set_.regions.clear();
  set_.runs.clear();
  shrinkDisparity(frame.disparity);
  const cv::Mat kernel = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
  for (const DisparityPlane& plane : planes) {
    markInPlane(plane, frame.camera);
    cv::erode(in_plane_, core_, kernel);
    const int labels = cv::connectedComponentsWithStats(core_, labels_, stats_, centroids_, 4, CV_32S);
    for (int label = 1; label < labels; ++label) {
      const int* stats = stats_[label];
      if (stats[cv::CC_STAT_AREA] * kCell * kCell < config_.min_region) continue;
      GrownRegion region;
      region.plane = plane;
      region.cells = stats[cv::CC_STAT_AREA];
      collectRuns({stats[cv::CC_STAT_LEFT], stats[cv::CC_STAT_TOP], stats[cv::CC_STAT_WIDTH], stats[cv::CC_STAT_HEIGHT]}, label,
                  &region);
      fitPlane(&region);
      set_.regions.push_back(region);
    }
  }
  return set_;
}

void RegionGrowing::shrinkDisparity(const cv::Mat1f& disparity) {
  disparity_.create(disparity.rows / kCell, disparity.cols / kCell);
  for (int row = 0; row < disparity_.rows; ++row) {
    const float* in = disparity[row * kCell];
    float* out = disparity_[row];
    for (int col = 0; col < disparity_.cols; ++col) out[col] = isValidDisparity(in[col * kCell]) ? in[col * kCell] : kNoDisparity;
  }
}

void RegionGrowing::markInPlane(const DisparityPlane& plane, const StereoCamera& camera) {
  const DisparityTolerance tolerance(camera, config_.region_tolerance_px, config_.region_tolerance_m, config_.tolerance_cap);
  in_plane_.create(disparity_.size());
  for (int row = 0; row < disparity_.rows; ++row)
    markRow(disparity_[row], disparity_.cols, static_cast<float>(plane.a * kCell), static_cast<float>(plane.at(0, row * kCell)),
            tolerance, in_plane_[row]);
}

void RegionGrowing::collectRuns(const cv::Rect& box, int label, GrownRegion* region) {
  region->first_run = static_cast<int>(set_.runs.size());
  for (int row = box.y; row < box.y + box.height; ++row) {
    const int* labels = labels_[row];
    for (int col = box.x; col < box.x + box.width; ++col) {
      if (labels[col] != label) continue;
      CellRun run{row, col, col};
      while (run.end < box.x + box.width && labels[run.end] == label) ++run.end;
      set_.runs.push_back(run);
      col = run.end;
    }
  }
  region->last_run = static_cast<int>(set_.runs.size());
}

void RegionGrowing::fitPlane(GrownRegion* region) const {
  PlaneFit fit;
  for (int i = region->first_run; i < region->last_run; ++i) {
    const CellRun& run = set_.runs[i];
    for (int col = run.begin; col < run.end; ++col) fit.add(col * kCell, run.row * kCell, disparity_(run.row, col));
  }
  if (const auto plane = fit.solve()) region->plane = *plane;
}

}  // namespace cabinet_articulation::core
