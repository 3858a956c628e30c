// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace cabinet_articulation::core {

/// Turns residuals r with scale s, and their derivatives, into r'. The square of r' is the negative log-likelihood of Student's t
/// in d dimensions: |r'|^2 = (nu + d) ln(1 + |r|^2 / (nu s^2)). `dimensions` is d where rows are dependent.
template <class Rows>
void makeRobust(double scale, double nu, int dimensions, Rows rows) {
  const double square = rows.col(0).squaredNorm() / (scale * scale);
  const double limit = std::sqrt((nu + dimensions) / nu);
  // For |r'| / |r| and d|r'| / d|r|, whose limits at zero are the same.
  const double value = std::sqrt((nu + dimensions) * std::log1p(square / nu));
  const double length = std::sqrt(square);
  const double across = square < 1e-8 ? limit : value / length;
  constexpr int kDerivatives = Rows::ColsAtCompileTime - 1;
  if constexpr (kDerivatives > 0) {
    if (square >= 1e-8) {
      const double along = (nu + dimensions) / (nu + square) * length / value;
      const auto derivatives = rows.template rightCols<kDerivatives>();
      const double factor = (along / across - 1) / (square * scale * scale);
      rows.template rightCols<kDerivatives>() += factor * rows.col(0) * (rows.col(0).transpose() * derivatives).eval();
    }
  }
  rows *= across / scale;
}

}  // namespace cabinet_articulation::core
