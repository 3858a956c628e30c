// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_segmenter.h"

#include <algorithm>
#include <cassert>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "cabinet_articulation/geometry/limits.h"
#include "planes/duplicate_merger.h"
#include "planes/enclosed_holes.h"
#include "planes/fold_search.h"
#include "planes/hole_filling.h"
#include "planes/metric_consensus.h"
#include "planes/photometric_refinement.h"
#include "planes/plane_consensus.h"
#include "planes/plane_mask.h"
#include "planes/region_competition.h"
#include "planes/region_growing.h"
#include "stereo/image_pool.h"

namespace cabinet_articulation::core {
namespace {

/// Memory to use again.
struct Outline {
  std::vector<CellRun> rows;
  std::vector<cv::Point2f> ends;
};

/// Only ends that reach beyond those of the row above or below are corners.
std::vector<cv::Point2f> hullOf(const GrownRegion& region, const RegionSet& set, Outline* outline) {
  auto& [rows, ends] = *outline;
  rows.clear();
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    if (rows.empty() || rows.back().row != run.row) rows.push_back(run);
    rows.back().end = run.end;
  }
  ends.clear();
  const auto addEnds = [&ends = ends](const CellRun& row, const CellRun* neighbour, int v) {
    if (!neighbour || neighbour->begin > row.begin) ends.emplace_back(row.begin * kCell, v);
    if (!neighbour || neighbour->end < row.end) ends.emplace_back(row.end * kCell - 1, v);
  };
  for (size_t i = 0; i < rows.size(); ++i) {
    addEnds(rows[i], i > 0 ? &rows[i - 1] : nullptr, rows[i].row * kCell);
    addEnds(rows[i], i + 1 < rows.size() ? &rows[i + 1] : nullptr, (rows[i].row + 1) * kCell - 1);
  }
  std::vector<cv::Point2f> hull;
  cv::convexHull(ends, hull);
  return hull;
}

__attribute__((target_clones("avx2", "default"))) int countMeasured(const float* disparity, int n) {
  int count = 0;
  for (int u = 0; u < n; ++u) count += isValidDisparity(disparity[u]) ? 1 : 0;
  return count;
}

int measuredPixels(const GrownRegion& region, const RegionSet& set, const cv::Mat1f& disparity) {
  int n = 0;
  for (int i = region.first_run; i < region.last_run; ++i) {
    const CellRun& run = set.runs[i];
    for (int v = run.row * kCell; v < (run.row + 1) * kCell; ++v)
      n += countMeasured(disparity[v] + run.begin * kCell, (run.end - run.begin) * kCell);
  }
  return n;
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

std::string sizeOf(const cv::Mat& image) { return std::to_string(image.cols) + "x" + std::to_string(image.rows) + " px"; }

void requireSameSizes(const DepthFrame& frame) {
  if (frame.left.empty() && frame.right.empty()) return;
  if (frame.left.size() != frame.disparity.size() || frame.right.size() != frame.disparity.size())
    throw std::invalid_argument("the disparity is " + sizeOf(frame.disparity) + ", the left image " + sizeOf(frame.left) +
                                " and the right image " + sizeOf(frame.right) + ", expected one size, or no images at all");
}

/// False for planes that no message holds: no front is that far, nor seen that much from its side.
bool isNear(const Plane& plane, const DisparityPlane& image) {
  if (!isWithin(plane.offset, limits::kPlaneOffset)) return false;
  const double numbers[] = {image.a, image.b, image.c};
  return std::all_of(std::begin(numbers), std::end(numbers), [](double x) { return isWithin(x, limits::kDisparityPlane); });
}

}  // namespace

struct PlaneSegmenter::Buffers {
  explicit Buffers(const PlanesConfig& config)
      : metric_consensus(config),
        consensus(config),
        growing(config),
        merger(config),
        competition(config),
        refinement(config),
        masks(config.max_regions) {}
  cv::Mat1f disparity;  ///< without holes
  MetricConsensus metric_consensus;
  PlaneConsensus consensus;
  RegionGrowing growing;
  FoldSearch fold_search;
  DuplicateMerger merger;
  RegionCompetition competition;
  PhotometricRefinement refinement;
  NoiseMask noise_mask;
  EnclosedHoles holes;
  Outline outline;
  ImagePool<cv::Mat1b> masks;
};

PlaneSegmenter::PlaneSegmenter(const PlanesConfig& config) : config_(config), buffers_(new Buffers(config)) {}

PlaneSegmenter::~PlaneSegmenter() = default;

std::vector<PlaneRegion> PlaneSegmenter::process(const DepthFrame& frame, double may_bend) {
  assert(frame.camera.isSane());
  requireSameSizes(frame);
  return config_.method == "paper" ? wholePlanes(frame) : connectedRegions(frame, frame.left.empty() ? may_bend : 0);
}

std::vector<PlaneRegion> PlaneSegmenter::connectedRegions(const DepthFrame& input, double may_bend) {
  Buffers& b = *buffers_;
  fillHoles(input.disparity, &b.disparity);
  DepthFrame frame = input;
  frame.disparity = b.disparity;
  const cv::Mat1f& disparity = b.disparity;
  RegionSet& set = b.growing.process(frame, b.consensus.process(frame));
  b.merger.process(disparity.size(), &set);
  // Each fold appends runs or drops its region; without one, nothing could merge again.
  const auto size = [&set] { return std::make_pair(set.regions.size(), set.runs.size()); };
  const auto flat = size();
  b.growing.unfold(frame.camera, may_bend, &b.fold_search);
  if (size() != flat) b.merger.process(disparity.size(), &set);
  b.growing.trim(b.competition.processCells(b.growing.cells(), set));
  b.merger.process(disparity.size(), &set);
  if (config_.refine && !frame.left.empty()) {
    b.refinement.process(frame, b.competition.process(disparity, set), &set);
    b.merger.process(disparity.size(), &set);
  }

  std::vector<PlaneRegion> regions;
  regions.reserve(set.regions.size());
  const cv::Mat1f& limit = b.competition.process(disparity, set);
  b.noise_mask.setFrame(
      disparity, DisparityTolerance(frame.camera, config_.mask_tolerance_px, config_.mask_tolerance_m, config_.tolerance_cap),
      limit);
  for (const GrownRegion& grown : set.regions) {
    const auto plane = toPlane(grown.plane, frame.camera);
    if (!plane || !isNear(*plane, grown.plane)) continue;
    cv::Mat1b mask = b.masks.take(disparity.size());
    b.noise_mask.label(grown.plane, &mask);
    regions.push_back({*plane, grown.plane, measuredPixels(grown, set, disparity), hullOf(grown, set, &b.outline), mask});
    b.holes.label(regions.back().hull, regions.back().inliers, &mask);
  }
  return regions;
}

std::vector<PlaneRegion> PlaneSegmenter::wholePlanes(const DepthFrame& frame) const {
  std::vector<PlaneRegion> regions;
  for (const Plane& plane : buffers_->metric_consensus.process(frame)) {
    const auto image = toDisparityPlane(plane, frame.camera);
    if (!image || !isNear(plane, *image)) continue;
    cv::Mat1b mask = buffers_->masks.take(frame.disparity.size());
    labelByDistance(frame, plane, config_.plane_distance, &mask);
    regions.push_back({plane, *image, cv::countNonZero(mask == kInPlane), hullOfInPlane(mask), mask});
  }
  return regions;
}

}  // namespace cabinet_articulation::core
