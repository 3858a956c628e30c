// SPDX-License-Identifier: BSD-3-Clause
#include "planes/cell_erosion.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace cabinet_articulation::core {
namespace {

cv::Mat1b randomCells(cv::Size size, int percent_set) {
  cv::Mat1b noise(size);
  cv::RNG(7).fill(noise, cv::RNG::UNIFORM, 0, 100);
  return noise < percent_set;
}

TEST(Erode, KeepsTheCellsThatOpencvKeeps) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(2, 3), cv::Size(31, 20), cv::Size(67, 40), cv::Size(320, 1)})
    for (const int percent : {0, 50, 95, 100}) {
      const cv::Mat1b cells = randomCells(size, percent);
      cv::Mat1b eroded, expected;
      erode(cells, {0, cells.rows}, &eroded);
      cv::erode(cells, expected, cv::Mat());
      EXPECT_EQ(cv::norm(eroded, expected, cv::NORM_INF), 0) << size << " with " << percent << " %";
    }
}

TEST(Erode, RowsBesideThoseAskedForCountButAreNotWritten) {
  const cv::Mat1b cells = randomCells({50, 30}, 90);
  cv::Mat1b eroded(cells.size(), 17), expected;
  erode(cells, {10, 20}, &eroded);
  cv::erode(cells, expected, cv::Mat());
  EXPECT_EQ(cv::norm(eroded.rowRange(10, 20), expected.rowRange(10, 20), cv::NORM_INF), 0);
  EXPECT_EQ(cv::countNonZero(eroded.rowRange(0, 10) != 17) + cv::countNonZero(eroded.rowRange(20, 30) != 17), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
