// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/label_layout.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace cabinet_articulation {
namespace {

constexpr int kGap = 2;                 ///< [px] between boxes
constexpr std::size_t kMostBoxes = 64;  ///< that anybody can read in an image, which bounds the time, too

int clamped(int value, int most) { return std::max(0, std::min(value, most)); }

bool isFree(const cv::Rect& box, const std::vector<cv::Rect>& taken) {
  return std::none_of(taken.begin(), taken.end(), [&box](const cv::Rect& other) { return (box & other).area() > 0; });
}

/// The nearest free place has each coordinate where it would best be, or touches a box that is there already.
std::optional<cv::Rect> nearestFree(const LabelBox& box, const std::vector<cv::Rect>& taken, const cv::Size& image) {
  const cv::Point last(image.width - box.size.width, image.height - box.size.height);
  if (last.x < 0 || last.y < 0) return std::nullopt;
  const cv::Point best(clamped(box.at.x - box.size.width / 2, last.x), clamped(box.at.y - box.size.height / 2, last.y));
  std::vector<int> xs{best.x}, ys{best.y};
  for (const cv::Rect& other : taken) {
    xs.insert(xs.end(), {other.x - box.size.width, other.x + other.width});
    ys.insert(ys.end(), {other.y - box.size.height, other.y + other.height});
  }
  std::optional<cv::Rect> nearest;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (const int y : ys) {
    for (const int x : xs) {
      if (x < 0 || y < 0 || x > last.x || y > last.y) continue;
      const std::int64_t dx = x - best.x, dy = y - best.y, distance = dx * dx + dy * dy;
      if (distance >= least || !isFree({cv::Point(x, y), box.size}, taken)) continue;
      least = distance;
      nearest = cv::Rect(cv::Point(x, y), box.size);
    }
  }
  return nearest;
}

}  // namespace

std::vector<std::optional<cv::Rect>> placeLabels(const std::vector<LabelBox>& boxes, const cv::Size& image) {
  std::vector<std::optional<cv::Rect>> places(boxes.size());
  std::vector<cv::Rect> taken;  // with a gap around
  for (std::size_t i = 0; i < boxes.size() && taken.size() < kMostBoxes; ++i) {
    places[i] = nearestFree(boxes[i], taken, image);
    if (places[i]) taken.push_back(*places[i] + cv::Size(2 * kGap, 2 * kGap) - cv::Point(kGap, kGap));
  }
  return places;
}

}  // namespace cabinet_articulation
