// SPDX-License-Identifier: BSD-3-Clause
#include "structure/coupling.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cabinet_articulation::core {
namespace {

/// In units of the noise; of pairs that follow one another only those that are some way apart.
std::vector<Eigen::Vector2d> distinct(const ConfigurationPairs& pairs, double sigma_position) {
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < pairs.first.size(); ++i) {
    const Eigen::Vector2d place =
        Eigen::Vector2d(pairs.first_metres * pairs.first[i], pairs.second_metres * pairs.second[i]) / (2 * sigma_position);
    if (places.empty() || (place - places.back()).norm() > 1) places.push_back(place);
  }
  return places;
}

}  // namespace

std::optional<double> ratioOfCoupled(const ConfigurationPairs& pairs, double sigma_position) {
  constexpr double kMeanSquare = 4;  // [4 sigma^2] at most, of residuals: those of a function are within twice the noise (ours)
  constexpr double kLeastRange = 3;  // [2 sigma] 6 cm: less says nothing of a function (ours)
  const std::vector<Eigen::Vector2d> places = distinct(pairs, sigma_position);
  if (places.size() < 4) return std::nullopt;
  Eigen::MatrixX2d A(static_cast<Eigen::Index>(places.size()), 2);
  Eigen::VectorXd b(A.rows());
  for (Eigen::Index i = 0; i < A.rows(); ++i) {
    A.row(i) << places[static_cast<std::size_t>(i)].x(), 1;
    b[i] = places[static_cast<std::size_t>(i)].y();
  }
  const double range = b.maxCoeff() - b.minCoeff();
  if (range < kLeastRange || A.col(0).maxCoeff() - A.col(0).minCoeff() < kLeastRange) return std::nullopt;
  const Eigen::Vector2d line = A.colPivHouseholderQr().solve(b);
  const double squares = (A * line - b).squaredNorm(), count = static_cast<double>(A.rows());
  const double log_odds = count * std::log(range / std::sqrt(2 * M_PI)) - squares / 2 - std::log(count);
  const double ratio = line[0] * pairs.first_metres / pairs.second_metres;
  return log_odds > 0 && squares < kMeanSquare * count ? std::optional<double>(ratio) : std::nullopt;
}

}  // namespace cabinet_articulation::core
