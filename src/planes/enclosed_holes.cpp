// SPDX-License-Identifier: BSD-3-Clause
#include "planes/enclosed_holes.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/plane_region.h"

namespace cabinet_articulation::core {
namespace {

__attribute__((target_clones("avx2", "default"))) int countFree(const std::uint8_t* labels, int n) {
  int count = 0;
  for (int u = 0; u < n; ++u) count += labels[u] == kFree;
  return count;
}

void markWays(const std::uint8_t* __restrict labels, int n, std::uint8_t* __restrict ways) {
  constexpr std::uint8_t kWay = std::numeric_limits<std::uint8_t>::max();
  for (int u = 0; u < n; ++u) ways[u] = labels[u] == kFree || labels[u] == kUnknown ? kWay : 0;
}

bool leadsOut(const CellRun& run, const cv::Size& box) {
  return run.row == 0 || run.row == box.height - 1 || run.begin == 0 || run.end == box.width;
}

}  // namespace

void EnclosedHoles::label(const std::vector<cv::Point2f>& hull, int inliers, cv::Mat1b* mask) {
  if (hull.empty()) return;
  const double area = cv::contourArea(hull);
  if (inliers > (1 - kHollowShare) * area) return;
  const cv::Rect box = cv::boundingRect(hull) & cv::Rect({0, 0}, mask->size());
  if (box.empty()) return;
  cv::Mat1b labels = (*mask)(box);
  int free = 0;
  for (int v = 0; v < box.height; ++v) free += countFree(labels[v], box.width);
  if (free < kHollowShare * area) return;
  ways_.create(mask->size());  // as large as the mask, so that it is allocated once
  cv::Mat1b ways = ways_(cv::Rect({0, 0}, box.size()));
  for (int v = 0; v < box.height; ++v) markWays(labels[v], box.width, ways[v]);
  connected_.process(ways);
  findEnclosed(box.size());
  int holes = 0;
  for (const CellRun& run : enclosed_) holes += countFree(labels[run.row] + run.begin, run.end - run.begin);
  if (holes < kHollowShare * area) return;
  for (const CellRun& run : enclosed_)
    std::replace(labels[run.row] + run.begin, labels[run.row] + run.end, static_cast<std::uint8_t>(kFree),
                 static_cast<std::uint8_t>(kHole));
}

/// The runs of the ways that do not lead out of the box.
void EnclosedHoles::findEnclosed(const cv::Size& box) {
  enclosed_.clear();
  for (const ConnectedRuns::Component& component : connected_.components()) {
    const auto begin = connected_.runs().begin() + component.first_run, end = connected_.runs().begin() + component.last_run;
    if (std::any_of(begin, end, [&box](const CellRun& run) { return leadsOut(run, box); })) continue;
    enclosed_.insert(enclosed_.end(), begin, end);
  }
}

}  // namespace cabinet_articulation::core
