// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/assignment.h"

#include <algorithm>
#include <limits>

namespace cabinet_articulation::core {
namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kFree = -1;
}  // namespace

// Every row also owns a private column (index columns + row) that stands for staying alone, so that a complete
// assignment always exists and each row costs one shortest path (Dijkstra on costs reduced by the potentials).
std::vector<int> assignRows(const Eigen::MatrixXd& cost, double alone) {
  const int rows = static_cast<int>(cost.rows());
  const int columns = static_cast<int>(cost.cols());
  const int all = columns + rows;
  const auto costOf = [&](int row, int column) {
    if (column >= columns) return column - columns == row ? alone : kInfinity;
    return cost(row, column) <= alone ? cost(row, column) : kInfinity;
  };
  std::vector<double> row_potential(rows, 0), column_potential(all, 0);
  std::vector<int> row_of(all, kFree);
  for (int start = 0; start < rows; ++start) {
    std::vector<double> distance(all, kInfinity);
    std::vector<int> from(all, kFree);  // the column before this one on the path; kFree: the start row
    std::vector<bool> done(all, false);
    int row = start;
    int last = kFree;
    double reached = 0;
    do {
      int nearest = kFree;
      for (int column = 0; column < all; ++column) {
        if (done[column]) continue;
        const double through = reached + costOf(row, column) - row_potential[row] - column_potential[column];
        if (through < distance[column]) {
          distance[column] = through;
          from[column] = last;
        }
        if (nearest == kFree || distance[column] < distance[nearest]) nearest = column;
      }
      last = nearest;
      done[last] = true;
      reached = distance[last];
      row = row_of[last];
    } while (row != kFree);
    for (int column = 0; column < all; ++column) {
      if (!done[column] || row_of[column] == kFree) continue;
      row_potential[row_of[column]] += reached - distance[column];
      column_potential[column] -= reached - distance[column];
    }
    row_potential[start] += reached;
    while (last != kFree) {
      const int before = from[last];
      row_of[last] = before == kFree ? start : row_of[before];
      last = before;
    }
  }
  std::vector<int> column_of(rows, kFree);
  for (int column = 0; column < columns; ++column)
    if (row_of[column] != kFree) column_of[row_of[column]] = column;
  return column_of;
}

}  // namespace cabinet_articulation::core
