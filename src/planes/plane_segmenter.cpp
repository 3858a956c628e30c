// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_segmenter.h"

#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/duplicate_merger.h"
#include "cabinet_articulation/planes/metric_consensus.h"
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

std::vector<cv::Point2f> hullOfInPlane(const cv::Mat1b& mask) {
  std::vector<cv::Point2f> ends, hull;
  for (int v = 0; v < mask.rows; ++v) {
    const std::uint8_t* begin = mask[v];
    const std::uint8_t* end = begin + mask.cols;
    const std::uint8_t* first = std::find(begin, end, kInPlane);
    if (first == end) continue;
    while (end[-1] != kInPlane) --end;
    ends.emplace_back(first - begin, v);
    ends.emplace_back(end - 1 - begin, v);
  }
  if (!ends.empty()) cv::convexHull(ends, hull);
  return hull;
}

}  // namespace

struct PlaneSegmenter::Buffers {
  explicit Buffers(const PlanesConfig& config)
      : metric_consensus(config), consensus(config), growing(config), merger(config), refinement(config), mask(config) {}
  MetricConsensus metric_consensus;
  PlaneConsensus consensus;
  RegionGrowing growing;
  DuplicateMerger merger;
  PhotometricRefinement refinement;
  PlaneMask mask;
};

PlaneSegmenter::PlaneSegmenter(const PlanesConfig& config) : config_(config), buffers_(new Buffers(config)) {}

PlaneSegmenter::~PlaneSegmenter() = default;

std::vector<PlaneRegion> PlaneSegmenter::process(const DepthFrame& frame) {
  return config_.method == "paper" ? wholePlanes(frame) : connectedRegions(frame);
}

std::vector<PlaneRegion> PlaneSegmenter::connectedRegions(const DepthFrame& frame) {
  const std::vector<DisparityPlane> planes = buffers_->consensus.process(frame);
  RegionSet& set = buffers_->growing.process(frame, planes);
  buffers_->merger.process(frame.disparity.size(), &set);
  if (config_.refine && !frame.left.empty() && !frame.right.empty()) {
    buffers_->mask.setFrame(frame, set);
    buffers_->refinement.process(frame, buffers_->mask.competitor(), &set);
    buffers_->merger.process(frame.disparity.size(), &set);
  }
  buffers_->mask.setFrame(frame, set);

  std::vector<PlaneRegion> regions;
  for (const GrownRegion& grown : set.regions) {
    const auto plane = toPlane(grown.plane, frame.camera);
    if (!plane) continue;
    regions.push_back(
        {*plane, grown.plane, grown.cells * kCell * kCell, hullOf(grown, set), buffers_->mask.label(frame, grown.plane)});
  }
  return regions;
}

std::vector<PlaneRegion> PlaneSegmenter::wholePlanes(const DepthFrame& frame) const {
  std::vector<PlaneRegion> regions;
  for (const Plane& plane : buffers_->metric_consensus.process(frame)) {
    const auto image = toDisparityPlane(plane, frame.camera);
    if (!image) continue;
    const cv::Mat1b mask = labelByDistance(frame, plane, config_.plane_distance);
    regions.push_back({plane, *image, cv::countNonZero(mask == kInPlane), hullOfInPlane(mask), mask});
  }
  return regions;
}

}  // namespace cabinet_articulation::core
