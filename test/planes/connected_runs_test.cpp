// SPDX-License-Identifier: BSD-3-Clause
#include "planes/connected_runs.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <set>

namespace cabinet_articulation::core {
namespace {

cv::Mat1b drawn(const std::vector<std::string>& rows) {
  cv::Mat1b mask(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()));
  for (int row = 0; row < mask.rows; ++row)
    for (int col = 0; col < mask.cols; ++col) mask(row, col) = rows[row][col] == '#' ? 255 : 0;
  return mask;
}

std::vector<int> sizes(const cv::Mat1b& mask) {
  ConnectedRuns connected;
  connected.process(mask);
  std::vector<int> result;
  for (const auto& component : connected.components()) result.push_back(component.cells);
  return result;
}

TEST(ConnectedRuns, CornersDoNotConnect) {
  EXPECT_EQ(sizes(drawn({"##..", "..##"})), (std::vector<int>{2, 2}));
  EXPECT_EQ(sizes(drawn({"###.", "..##"})), (std::vector<int>{5}));
}

TEST(ConnectedRuns, BranchesThatMeetLaterAreOne) {
  EXPECT_EQ(sizes(drawn({"#.#.#", "#.#.#", "#####", ".....", "##.##"})), (std::vector<int>{11, 2, 2}));
  EXPECT_EQ(sizes(drawn({"#...#", "#.#.#", "#.###", "###.."})), (std::vector<int>{12}));
}

TEST(ConnectedRuns, EmptyRowsSeparate) {
  EXPECT_EQ(sizes(drawn({"###", "...", "###"})), (std::vector<int>{3, 3}));
  EXPECT_TRUE(sizes(drawn({"...", "..."})).empty());
  EXPECT_TRUE(sizes(cv::Mat1b()).empty());
}

TEST(ConnectedRuns, AgreesWithOpenCvOnNoise) {
  cv::RNG rng(4);
  for (const double share : {0.3, 0.5, 0.6, 0.8}) {
    cv::Mat1b mask(60, 90);
    for (std::uint8_t& cell : mask) cell = rng.uniform(0.0, 1.0) < share ? 255 : 0;
    cv::Mat1i labels;
    const int n = cv::connectedComponents(mask, labels, 4);
    ConnectedRuns connected;
    connected.process(cv::Mat1b(10, 10, std::uint8_t{255}));
    connected.process(mask);
    ASSERT_EQ(static_cast<int>(connected.components().size()), n - 1);
    int cells = 0;
    for (const auto& component : connected.components()) {
      std::set<int> seen;
      for (int i = component.first_run; i < component.last_run; ++i) {
        const CellRun& run = connected.runs()[i];
        for (int col = run.begin; col < run.end; ++col) seen.insert(labels(run.row, col));
        cells += run.end - run.begin;
      }
      EXPECT_EQ(seen.size(), 1U);
      EXPECT_EQ(seen.count(0), 0U);
    }
    EXPECT_EQ(cells, cv::countNonZero(mask));
  }
}

}  // namespace
}  // namespace cabinet_articulation::core
