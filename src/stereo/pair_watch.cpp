// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/pair_watch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace cabinet_articulation::core {
namespace {

constexpr size_t kRecent = 12;       ///< frames that are compared (ours: 0.8 s at 15 Hz, a view changes little)
constexpr size_t kFewestOfEach = 3;  ///< frames of either contrast (ours: a flash or two is no alternation)
constexpr int kFewestChanges = 5;    ///< between the two contrasts; at most 11 in a window
constexpr double kDistinct = 0.4;    ///< [log] least gap between the two contrasts: a factor of 1.5
constexpr int kRowStep = 4;          ///< [px] every fourth row is enough for a mean
constexpr double kDark = 8;          ///< [grey levels] added to the brightness: below, contrast is mostly noise
constexpr double kMatched = 0.2;     ///< share of pixels with a disparity that no wrong pair reaches
constexpr int kAgain = 30;           ///< frames until a pair without matches is tried the other way round again (2 s at 15 Hz)
constexpr double kMuchMore = 4;      ///< times as many matches the other way round

double logContrast(const cv::Mat& image) {
  double steps = 0, brightness = 0, count = 0;
  for (int v = 0; v < image.rows; v += kRowStep) {
    const std::uint8_t* row = image.ptr<std::uint8_t>(v);
    int row_steps = 0, row_brightness = 0;
    for (int u = 1; u < image.cols; ++u) {
      row_steps += std::abs(row[u] - row[u - 1]);
      row_brightness += row[u];
    }
    steps += row_steps;
    brightness += row_brightness;
    count += image.cols - 1;
  }
  return count > 0 ? std::log((steps / count + 0.1) / (brightness / count + kDark)) : 0;
}

double matchedShare(const cv::Mat1f& disparity) {
  const auto valid = std::count_if(disparity.begin(), disparity.end(), isValidDisparity);
  return disparity.empty() ? 0 : static_cast<double>(valid) / static_cast<double>(disparity.total());
}

}  // namespace

bool ProjectorWatch::lacksPattern(const cv::Mat& left) {
  contrasts_.push_back(logContrast(left));
  if (contrasts_.size() > kRecent) contrasts_.pop_front();
  if (contrasts_.size() < 2 * kFewestOfEach) return false;
  std::vector<double> sorted(contrasts_.begin(), contrasts_.end());
  std::sort(sorted.begin(), sorted.end());
  size_t split = kFewestOfEach;  // the first of the higher contrast
  for (size_t i = split; i + kFewestOfEach <= sorted.size(); ++i)
    if (sorted[i] - sorted[i - 1] > sorted[split] - sorted[split - 1]) split = i;
  const double gap = sorted[split] - sorted[split - 1];
  const double spread = std::max(sorted[split - 1] - sorted.front(), sorted.back() - sorted[split]);
  if (gap < kDistinct || gap < spread) return false;
  const double threshold = (sorted[split] + sorted[split - 1]) / 2;
  int changes = 0;
  for (size_t i = 1; i < contrasts_.size(); ++i) changes += (contrasts_[i] > threshold) != (contrasts_[i - 1] > threshold);
  return changes >= kFewestChanges && contrasts_.back() < threshold;
}

bool SwapWatch::looksSwapped(const DepthFrame& frame, BlockMatcher* matcher) {
  const double share = matchedShare(frame.disparity);
  if (share > kMatched / kMuchMore || few_matches_++ % kAgain != 0) return false;
  const double swapped = matchedShare(matcher->process(frame.right, frame.left, frame.camera).disparity);
  return swapped > kMatched && swapped > kMuchMore * share;
}

}  // namespace cabinet_articulation::core
