// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <opencv2/core.hpp>
#include <vector>

namespace cabinet_articulation::core {

/// Images whose memory is lent again once nobody holds them any more (ours). The heap returns blocks of this size to the system,
/// and every page then costs a fault. A frame's masks alone are some 6 MB. Whoever holds an image may release it in any thread.
template <class Image>
class ImagePool {
 public:
  /// Images beyond `capacity` that are in use at once are lent too, but their memory does not come back.
  explicit ImagePool(size_t capacity) : capacity_(capacity) {}

  /// An image of undefined contents that nobody else holds.
  Image take(cv::Size size) {
    if (size.empty()) return Image(size);
    const auto outdated = [size](const Image& image) { return image.size() != size; };
    images_.erase(std::remove_if(images_.begin(), images_.end(), outdated), images_.end());
    for (const Image& image : images_)
      if (!heldByOthers(image)) return image;
    Image image(size);
    if (images_.size() < capacity_) images_.push_back(image);
    return image;
  }

 private:
  /// Adding nothing reads the count in order with the other holders' releases, which may happen in other threads.
  static bool heldByOthers(const Image& image) { return CV_XADD(&image.u->refcount, 0) > 1; }

  size_t capacity_;
  std::vector<Image> images_;
};

}  // namespace cabinet_articulation::core
