// SPDX-License-Identifier: BSD-3-Clause
#include "planes/enclosed_holes.h"

#include <opencv2/imgproc.hpp>

#include "cabinet_articulation/planes/plane_region.h"

namespace cabinet_articulation::core {
namespace {

enum Passage : std::uint8_t { kWall, kWay, kOutside };

}  // namespace

void EnclosedHoles::label(const std::vector<cv::Point2f>& hull, int inliers, cv::Mat1b* mask) {
  if (hull.empty()) return;
  const double area = cv::contourArea(hull);
  if (inliers > (1 - kHollowShare) * area) return;
  const cv::Rect box = cv::boundingRect(hull) & cv::Rect({0, 0}, mask->size());
  if (box.empty()) return;
  cv::Mat1b labels = (*mask)(box);
  open_.create(box.height + 2, box.width + 2);
  open_.setTo(kWay);
  enclosed_.create(box.size());
  for (int v = 0; v < box.height; ++v)
    for (int u = 0; u < box.width; ++u) open_(v + 1, u + 1) = labels(v, u) == kFree || labels(v, u) == kUnknown ? kWay : kWall;
  cv::floodFill(open_, {0, 0}, kOutside);
  int holes = 0;
  for (int v = 0; v < box.height; ++v) {
    for (int u = 0; u < box.width; ++u) {
      enclosed_(v, u) = labels(v, u) == kFree && open_(v + 1, u + 1) == kWay;
      holes += enclosed_(v, u);
    }
  }
  if (holes >= kHollowShare * area) labels.setTo(kHole, enclosed_);
}

}  // namespace cabinet_articulation::core
