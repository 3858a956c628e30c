// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_segmenter.h"

#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/duplicate_merger.h"
#include "cabinet_articulation/planes/photometric_refinement.h"
#include "cabinet_articulation/planes/plane_consensus.h"
#include "cabinet_articulation/planes/plane_mask.h"
#include "cabinet_articulation/planes/region_growing.h"

namespace cabinet_articulation::core {
namespace {

std::vector<cv::Point2f> hullOf(const GrownRegion& region, const RegionSet& set) {
  std::vector<cv::Point2f> ends, hull;
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    for (const int u : {run.begin * kCell, run.end * kCell - 1})
      for (const int v : {run.row * kCell, (run.row + 1) * kCell - 1}) ends.emplace_back(u, v);
  }
  cv::convexHull(ends, hull);
  return hull;
}

}  // namespace

struct PlaneSegmenter::Buffers {
  explicit Buffers(const PlanesConfig& config)
      : consensus(config), growing(config), merger(config), refinement(config), mask(config) {}
  PlaneConsensus consensus;
  RegionGrowing growing;
  DuplicateMerger merger;
  PhotometricRefinement refinement;
  PlaneMask mask;
};

PlaneSegmenter::PlaneSegmenter(const PlanesConfig& config) : config_(config), buffers_(new Buffers(config)) {}

PlaneSegmenter::~PlaneSegmenter() = default;

std::vector<PlaneRegion> PlaneSegmenter::process(const DepthFrame& frame) {
  const cv::Size cells(frame.disparity.cols / kCell, frame.disparity.rows / kCell);
  const std::vector<DisparityPlane> planes = buffers_->consensus.process(frame);
  RegionSet& set = buffers_->growing.process(frame, planes);
  buffers_->merger.process(cells, &set);
  if (config_.refine && !frame.left.empty() && !frame.right.empty()) {
    buffers_->refinement.setFrame(frame);
    for (GrownRegion& region : set.regions)
      if (const auto refined = buffers_->refinement.refine(region, set)) region.plane = *refined;
    buffers_->merger.process(cells, &set);
  }
  buffers_->mask.setFrame(frame, set);

  std::vector<PlaneRegion> regions;
  for (const GrownRegion& grown : set.regions) {
    const auto plane = toPlane(grown.plane, frame.camera);
    if (!plane || static_cast<int>(regions.size()) >= config_.max_regions) continue;
    regions.push_back(
        {*plane, grown.plane, grown.cells * kCell * kCell, hullOf(grown, set), buffers_->mask.label(frame, grown.plane)});
  }
  return regions;
}

}  // namespace cabinet_articulation::core
