// SPDX-License-Identifier: BSD-3-Clause
#include "planes/plane_mask.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cabinet_articulation::core {
namespace detail {

/// One image row of a plane: disparity = slope u + start.
struct RowPlane {
  RowPlane(const DisparityPlane& plane, int v) : slope(static_cast<float>(plane.a)), start(static_cast<float>(plane.at(0, v))) {}
  float at(int u) const { return slope * static_cast<float>(u) + start; }
  float slope, start;
};

}  // namespace detail
namespace {

using detail::RowPlane;
constexpr int kBlock = 32;  ///< [px] side: as many labels as bytes in a vector

// Selections without branches, so that the loops vectorise. A point in front of the plane has the larger disparity.
inline std::uint8_t chooseLabel(float disparity, float residual, float tolerance, int in_plane) {
  const int outside = residual > 0 ? kOccluded : kFree;
  const int label = std::abs(residual) <= tolerance ? in_plane : outside;
  return static_cast<std::uint8_t>(isValidDisparity(disparity) ? label : kUnknown);
}

/// Images that the labels of a box are made from, and the labels.
struct BoxImages {
  const cv::Mat1f &disparity, &limit, &tolerance;
  cv::Mat1b& labels;
};

inline void labelPixels(const float* __restrict disparity, const float* __restrict limit, const float* __restrict tolerance,
                        int first, int n, RowPlane plane, std::uint8_t* __restrict labels) {
  for (int i = 0; i < n; ++i) {
    const float residual = disparity[i] - plane.at(first + i);
    const int in_plane = std::abs(residual) > limit[i] ? kOtherPlane : kInPlane;
    const int outside = residual > 0 ? kOccluded : kFree;
    const int label = std::abs(residual) <= tolerance[i] ? in_plane : outside;
    labels[i] = static_cast<std::uint8_t>(tolerance[i] < 0 ? kUnknown : label);
  }
}

/// Block by block: a loop of a known length needs no preparation, which would cost as much as the few blocks of a usual row.
__attribute__((target_clones("avx2", "default"))) void labelBox(const BoxImages& images, const cv::Rect& box,
                                                                const DisparityPlane& plane) {
  for (int v = box.y; v < box.y + box.height; ++v) {
    const RowPlane row(plane, v);
    const float *disparity = images.disparity[v], *limit = images.limit[v], *tolerance = images.tolerance[v];
    std::uint8_t* labels = images.labels[v];
    int u = box.x;
    const int end = box.x + box.width;
    for (; u + kBlock <= end; u += kBlock) labelPixels(disparity + u, limit + u, tolerance + u, u, kBlock, row, labels + u);
    labelPixels(disparity + u, limit + u, tolerance + u, u, end - u, row, labels + u);
  }
}

/// The row's part of what all planes share. The arrays do not overlap.
__attribute__((target_clones("avx2", "default"))) void addRow(const float* __restrict disparity, int n,
                                                              DisparityTolerance tolerance, float* __restrict tolerances,
                                                              float* __restrict least, float* __restrict most,
                                                              std::uint8_t* __restrict free, std::uint8_t* __restrict occluded) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  // One selection a loop: compilers make branches of several by the same condition.
  for (int u = 0; u < n; ++u) {
    const float of_measured = tolerance.at(disparity[u]);
    tolerances[u] = isValidDisparity(disparity[u]) ? of_measured : -1;
  }
  for (int u = 0; u < n; ++u) least[u] = std::min(least[u], tolerances[u] < 0 ? kInfinity : disparity[u]);
  for (int u = 0; u < n; ++u) most[u] = std::max(most[u], tolerances[u] < 0 ? -1 : disparity[u]);
  for (int u = 0; u < n; ++u) free[u] = static_cast<std::uint8_t>(tolerances[u] < 0 ? kUnknown : kFree);
  for (int u = 0; u < n; ++u) occluded[u] = static_cast<std::uint8_t>(tolerances[u] < 0 ? kUnknown : kOccluded);
}

__attribute__((target_clones("avx2", "default"))) void labelRow(const float* disparity, int n, RowPlane plane, float tolerance,
                                                                std::uint8_t* out) {
  for (int u = 0; u < n; ++u) out[u] = chooseLabel(disparity[u], disparity[u] - plane.at(u), tolerance * disparity[u], kInPlane);
}

}  // namespace

void NoiseMask::setFrame(const cv::Mat1f& disparity, const DisparityTolerance& tolerance, const cv::Mat1f& limit) {
  disparity_ = disparity;
  limit_ = limit;
  tolerance_.create(disparity.size());
  free_.create(disparity.size());
  occluded_.create(disparity.size());
  ranges_.clear();
  for (int top = 0; top < disparity.rows; top += kBlock) addBand(top, std::min(top + kBlock, disparity.rows), tolerance);
}

/// The ranges of a row of blocks.
void NoiseMask::addBand(int top, int bottom, const DisparityTolerance& tolerance) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const int n = disparity_.cols;
  least_.assign(n, kInfinity);
  most_.assign(n, -1);
  for (int v = top; v < bottom; ++v)
    addRow(disparity_[v], n, tolerance, tolerance_[v], least_.data(), most_.data(), free_[v], occluded_[v]);
  for (int begin = 0; begin < n; begin += kBlock) {
    const int end = std::min(begin + kBlock, n);
    const float most = *std::max_element(most_.begin() + begin, most_.begin() + end);
    ranges_.push_back({*std::min_element(least_.begin() + begin, least_.begin() + end), most, tolerance.at(most)});
  }
}

// Rounding keeps the order of numbers: no pixel of a block has a residual outside of those of the block's ends, to the last bit.
NoiseMask::Place NoiseMask::placeOf(const Range& range, const RowPlane& first, const RowPlane& last, int begin, int end) {
  const auto [least, most] = std::minmax({first.at(begin), first.at(end - 1), last.at(begin), last.at(end - 1)});
  if (range.most - least < -range.tolerance) return Place::kBehind;
  return range.least - most > range.tolerance ? Place::kBefore : Place::kAcross;
}

void NoiseMask::label(const DisparityPlane& plane, cv::Mat1b* mask) const {
  mask->create(disparity_.size());
  auto range = ranges_.begin();
  for (int top = 0; top < mask->rows; top += kBlock) {
    const int bottom = std::min(top + kBlock, mask->rows);
    const RowPlane first(plane, top), last(plane, bottom - 1);
    Place place = Place::kAcross;  // of the blocks from `begin` on
    int begin = 0;
    for (int u = 0; u < mask->cols; u += kBlock, ++range) {
      const Place next = placeOf(*range, first, last, u, std::min(u + kBlock, mask->cols));
      if (next != place) labelBlocks(plane, place, {begin, top, u - begin, bottom - top}, mask);
      if (next != place) begin = u;
      place = next;
    }
    labelBlocks(plane, place, {begin, top, mask->cols - begin, bottom - top}, mask);
  }
}

void NoiseMask::labelBlocks(const DisparityPlane& plane, Place place, const cv::Rect& box, cv::Mat1b* mask) const {
  if (box.empty()) return;
  if (place == Place::kAcross) return labelBox({disparity_, limit_, tolerance_, *mask}, box, plane);
  const cv::Mat1b& whole = place == Place::kBehind ? free_ : occluded_;
  for (int v = box.y; v < box.y + box.height; ++v) std::copy_n(whole[v] + box.x, box.width, (*mask)[v] + box.x);
}

// With p = z r and disparity = f B / z, the distance to the plane is offset |disparity - disparity of the plane| / disparity.
void labelByDistance(const DepthFrame& frame, const Plane& plane, double distance, cv::Mat1b* mask) {
  mask->create(frame.disparity.size());
  const auto image = toDisparityPlane(plane, frame.camera);
  if (!image) {
    mask->setTo(kUnknown);
    return;
  }
  const float tolerance = static_cast<float>(distance / plane.offset);
  for (int v = 0; v < mask->rows; ++v) labelRow(frame.disparity[v], mask->cols, RowPlane(*image, v), tolerance, (*mask)[v]);
}

}  // namespace cabinet_articulation::core
