// SPDX-License-Identifier: BSD-3-Clause
#include "planes/mask_pool.h"

#include <algorithm>

namespace cabinet_articulation::core {
namespace {

/// Adding nothing reads the count in order with the other holders' releases, which may happen in other threads.
bool heldByOthers(const cv::Mat1b& mask) { return CV_XADD(&mask.u->refcount, 0) > 1; }

}  // namespace

cv::Mat1b MaskPool::take(cv::Size size) {
  if (size.empty()) return cv::Mat1b(size);
  const auto outdated = [size](const cv::Mat1b& mask) { return mask.size() != size; };
  masks_.erase(std::remove_if(masks_.begin(), masks_.end(), outdated), masks_.end());
  for (const cv::Mat1b& mask : masks_)
    if (!heldByOthers(mask)) return mask;
  cv::Mat1b mask(size);
  if (masks_.size() < capacity_) masks_.push_back(mask);
  return mask;
}

}  // namespace cabinet_articulation::core
