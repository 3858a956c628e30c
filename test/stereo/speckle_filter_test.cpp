// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/speckle_filter.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

namespace cabinet_articulation::core {
namespace {

constexpr std::int16_t kUnmatched = -16;

/// Noise of so many sixteenths on steps, in which `percent` of the pixels have no match.
cv::Mat1s noisySteps(cv::Size size, int noise, int percent, int seed) {
  cv::RNG random(seed);
  cv::Mat1s sixteenths(size);
  for (int v = 0; v < size.height; ++v)
    for (int u = 0; u < size.width; ++u) {
      const int disparity = u / 9 % 3 * 40 + v / 7 % 2 * 25 + random.uniform(0, noise + 1);
      sixteenths(v, u) = random.uniform(0, 100) < percent ? kUnmatched : static_cast<std::int16_t>(disparity);
    }
  return sixteenths;
}

TEST(SpeckleFilter, LeavesWhatOpencvLeaves) {
  SpeckleFilter filter;
  int seed = 0;
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(1, 40), cv::Size(40, 1), cv::Size(70, 50), cv::Size(33, 64)})
    for (const int noise : {0, 6, 30})
      for (const int percent : {0, 10, 45, 100})
        for (const int largest : {1, 8, 100}) {
          cv::Mat1s filtered = noisySteps(size, noise, percent, ++seed), expected = filtered.clone();
          filter.process(largest, 4, kUnmatched, &filtered);
          cv::filterSpeckles(expected, kUnmatched, largest, 4);
          EXPECT_EQ(cv::norm(filtered, expected, cv::NORM_INF), 0) << size << ", noise " << noise << ", seed " << seed;
        }
}

TEST(SpeckleFilter, APatchWindsAroundOthers) {
  cv::Mat1s spiral(5, 7, kUnmatched);
  for (int u = 0; u < 7; ++u) spiral(0, u) = spiral(4, u) = 100;
  for (int v = 0; v < 5; ++v) spiral(v, 6) = 100;
  spiral(2, 2) = 100;
  cv::Mat1s filtered = spiral.clone();
  SpeckleFilter().process(16, 4, kUnmatched, &filtered);
  spiral(2, 2) = kUnmatched;
  EXPECT_EQ(cv::norm(filtered, spiral, cv::NORM_INF), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
