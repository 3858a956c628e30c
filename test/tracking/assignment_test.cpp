// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/matching/assignment.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace cabinet_articulation::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double totalCost(const Eigen::MatrixXd& cost, double alone, const std::vector<int>& columns) {
  double total = 0;
  for (int row = 0; row < cost.rows(); ++row) total += columns[row] < 0 ? alone : cost(row, columns[row]);
  return total;
}

/// Least total cost of the rows from `row` on, by trying everything.
double leastCost(const Eigen::MatrixXd& cost, double alone, int row, std::set<int> taken) {
  if (row == cost.rows()) return 0;
  double best = alone + leastCost(cost, alone, row + 1, taken);
  for (int column = 0; column < cost.cols(); ++column) {
    if (!taken.insert(column).second) continue;
    best = std::min(best, cost(row, column) + leastCost(cost, alone, row + 1, taken));
    taken.erase(column);
  }
  return best;
}

TEST(Assignment, IsTheCheapestOfAll) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int run = 0; run < 300; ++run) {
    Eigen::MatrixXd cost(random() % 6, random() % 6);
    for (int i = 0; i < cost.size(); ++i) cost(i) = uniform(random) < 0.3 ? kInfinity : uniform(random);
    const double alone = 0.2 + uniform(random);
    const std::vector<int> columns = assignRows(cost, alone);
    std::set<int> taken;
    for (int column : columns) {
      EXPECT_TRUE(column < 0 || taken.insert(column).second) << "column taken twice";
    }
    EXPECT_NEAR(totalCost(cost, alone, columns), leastCost(cost, alone, 0, {}), 1e-12);
  }
}

TEST(Assignment, FirstMatchWouldBeWorse) {
  Eigen::MatrixXd cost(2, 2);
  cost << 0.1, 0.2, 0.15, 0.9;
  EXPECT_EQ(assignRows(cost, 10), (std::vector<int>{1, 0}));
}

TEST(Assignment, LeavesForbiddenAndExpensivePairsAlone) {
  Eigen::MatrixXd cost(2, 1);
  cost << kInfinity, 2;
  EXPECT_EQ(assignRows(cost, 1), (std::vector<int>{-1, -1}));
}

TEST(Assignment, EmptyInEitherDirection) {
  EXPECT_TRUE(assignRows(Eigen::MatrixXd(0, 3), 1).empty());
  EXPECT_EQ(assignRows(Eigen::MatrixXd(2, 0), 1), (std::vector<int>{-1, -1}));
}

}  // namespace
}  // namespace cabinet_articulation::core
