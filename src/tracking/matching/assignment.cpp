// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/matching/assignment.h"

#include <limits>

namespace cabinet_articulation::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kFree = -1;

/// Assigns one row after the other, each along a shortest path (Dijkstra on costs reduced by the potentials). Every row also
/// owns a private column (index columns + row) that stands for staying alone, so that a complete assignment always exists.
class Assignment {
 public:
  Assignment(const Eigen::MatrixXd& cost, double alone)
      : cost_(cost),
        alone_(alone),
        columns_(static_cast<int>(cost.cols())),
        all_(columns_ + static_cast<int>(cost.rows())),
        row_potential_(cost.rows(), 0),
        column_potential_(all_, 0),
        row_of_(all_, kFree) {}

  void add(int start) {
    const Path path = shortestPath(start);
    for (int column = 0; column < all_; ++column) {
      if (!path.done[column] || row_of_[column] == kFree) continue;
      row_potential_[row_of_[column]] += path.length - path.distance[column];
      column_potential_[column] -= path.length - path.distance[column];
    }
    row_potential_[start] += path.length;
    for (int column = path.last; column != kFree; column = path.from[column])
      row_of_[column] = path.from[column] == kFree ? start : row_of_[path.from[column]];
  }

  std::vector<int> columnOfRows() const {
    std::vector<int> column_of(row_potential_.size(), kFree);
    for (int column = 0; column < columns_; ++column)
      if (row_of_[column] != kFree) column_of[row_of_[column]] = column;
    return column_of;
  }

 private:
  struct Path {
    std::vector<double> distance;
    std::vector<int> from;  ///< the column before; kFree: the start row
    std::vector<bool> done;
    int last = kFree;
    double length = 0;
  };

  double costOf(int row, int column) const {
    if (column >= columns_) return column - columns_ == row ? alone_ : kInfinity;
    return cost_(row, column) <= alone_ ? cost_(row, column) : kInfinity;
  }

  /// From a row to the nearest column that no row has.
  Path shortestPath(int row) const {
    Path path{std::vector<double>(all_, kInfinity), std::vector<int>(all_, kFree), std::vector<bool>(all_, false)};
    do {
      int nearest = kFree;
      for (int column = 0; column < all_; ++column) {
        if (path.done[column]) continue;
        const double through = path.length + costOf(row, column) - row_potential_[row] - column_potential_[column];
        if (through < path.distance[column]) {
          path.distance[column] = through;
          path.from[column] = path.last;
        }
        if (nearest == kFree || path.distance[column] < path.distance[nearest]) nearest = column;
      }
      path.last = nearest;
      path.done[nearest] = true;
      path.length = path.distance[nearest];
      row = row_of_[nearest];
    } while (row != kFree);
    return path;
  }

  const Eigen::MatrixXd& cost_;
  double alone_;
  int columns_, all_;
  std::vector<double> row_potential_, column_potential_;
  std::vector<int> row_of_;
};

}  // namespace

std::vector<int> assignRows(const Eigen::MatrixXd& cost, double alone) {
  Assignment assignment(cost, alone);
  for (int row = 0; row < static_cast<int>(cost.rows()); ++row) assignment.add(row);
  return assignment.columnOfRows();
}

}  // namespace cabinet_articulation::core
