// SPDX-License-Identifier: BSD-3-Clause
#include "planes/enclosed_holes.h"

#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/plane_region.h"

namespace cabinet_articulation::core {
namespace {

enum Passage : std::uint8_t { kWall, kWay, kOutside };

__attribute__((target_clones("avx2", "default"))) int countFree(const std::uint8_t* labels, int n) {
  int count = 0;
  for (int u = 0; u < n; ++u) count += labels[u] == kFree;
  return count;
}

void markWays(const std::uint8_t* __restrict labels, int n, std::uint8_t* __restrict passages) {
  for (int u = 0; u < n; ++u) passages[u] = labels[u] == kFree || labels[u] == kUnknown ? kWay : kWall;
}

int markEnclosed(const std::uint8_t* __restrict labels, const std::uint8_t* __restrict passages, int n,
                 std::uint8_t* __restrict enclosed) {
  int count = 0;
  for (int u = 0; u < n; ++u) {
    enclosed[u] = labels[u] == kFree && passages[u] == kWay ? 1 : 0;
    count += enclosed[u];
  }
  return count;
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
  // Parts of images as large as the mask, which are allocated once.
  open_.create(mask->rows + 2, mask->cols + 2);
  enclosed_.create(mask->size());
  reached_.create(open_.rows + 2, open_.cols + 2);
  cv::Mat1b open = open_(cv::Rect(0, 0, box.width + 2, box.height + 2)), enclosed = enclosed_(box);
  open.setTo(kWay);
  for (int v = 0; v < box.height; ++v) markWays(labels[v], box.width, open[v + 1] + 1);
  cv::Mat1b reached = reached_(cv::Rect(0, 0, open.cols + 2, open.rows + 2));
  reached.setTo(0);
  cv::floodFill(open, reached, {0, 0}, kOutside);
  int holes = 0;
  for (int v = 0; v < box.height; ++v) holes += markEnclosed(labels[v], open[v + 1] + 1, box.width, enclosed[v]);
  if (holes >= kHollowShare * area) labels.setTo(kHole, enclosed);
}

}  // namespace cabinet_articulation::core
