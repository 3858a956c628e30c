// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cabinet_articulation::core {

inline double innerProduct(double a, double b) { return a * b; }
inline double innerProduct(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.dot(b); }

/// Correlation of each residual with the next, from 0 to below 1; 0 where all residuals are 0. They are cut beforehand, so that
/// single outliers do not hide it.
template <class Residual>
double correlationWithNext(const std::vector<Residual>& cut) {
  constexpr double kMost = 0.99;  // beyond, almost nothing would count as independent (ours)
  double product = 0, square = 0;
  for (std::size_t i = 0; i < cut.size(); ++i) {
    if (i > 0) product += innerProduct(cut[i], cut[i - 1]);
    square += innerProduct(cut[i], cut[i]);
  }
  return square > 0 ? std::clamp(product / square, 0.0, kMost) : 0;
}

/// Share of residuals that are independent of one another, where each has this correlation with the next.
inline double independentShare(double correlation) { return (1 - correlation) / (1 + correlation); }

/// Poses spread evenly over a path from q_min to q_max that would tell as much of how it leads, of at most those there are. What
/// they tell goes with the square of their distance from their mean (Fisher's information on a slope). A uniform distribution
/// has 1/12 of its squared range. Poses of a rest, however many, lie near that mean, and count for what was seen elsewhere.
inline double informativePoses(const std::vector<double>& q, double q_min, double q_max) {
  const double range = q_max - q_min, n = static_cast<double>(q.size());
  if (!(range > 0)) return 1;
  double mean = 0, square = 0;
  for (const double place : q) mean += std::clamp((place - q_min) / range, 0.0, 1.0) / n;
  for (const double place : q) square += std::pow(std::clamp((place - q_min) / range, 0.0, 1.0) - mean, 2);
  return std::clamp(12 * square, 1.0, n);
}

}  // namespace cabinet_articulation::core
