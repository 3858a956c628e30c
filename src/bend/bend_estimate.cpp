// SPDX-License-Identifier: BSD-3-Clause
#include "bend/bend_estimate.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {

constexpr int kLeastViews = 4 * kBendTerms;  ///< ours: before a camera at rest, one door that turns gives up to 26 (measured)
constexpr double kSignificance = 3.09;       ///< Gaussian quantile: exceeded by chance once in a thousand times
constexpr double kLargest = 1;       ///< [px] sigma of a term before any view (ours: a PrimeSense bends by 0.75 px at most)
constexpr double kRounding = 0.036;  ///< [px] sigma of disparities in steps of 1/8 px (PrimeSense), the least noise there is
constexpr double kPlane = 3;         ///< unknowns of a view's plane
constexpr int kReweightings = 10;    ///< more change the result by less than a thousandth (measured)
constexpr int kShrinkings = 50;      ///< the same

/// Sums of least squares over weighted views, and what is known beforehand.
struct Sums {
  BendVector gradient = BendVector::Zero();
  BendMatrix information = BendMatrix::Identity() / (kLargest * kLargest);

  void add(const BendView& view, double weight) {
    gradient += weight * view.gradient;
    information += weight * view.information;
  }
  BendVector solve() const { return information.llt().solve(gradient); }
};

/// [1/px^2] of the view's own noise about a bend.
double weightOf(const BendView& view, const BendVector& bend) {
  const double variance = view.squaresWithout(bend) / std::max(1.0, view.windows - kPlane);
  return 1 / std::max(variance, kRounding * kRounding);
}

Sums sumsOf(const std::vector<BendView>& views, const BendVector& bend) {
  Sums sums;
  for (const BendView& view : views) sums.add(view, weightOf(view, bend));
  return sums;
}

/// By how far the estimate changes without one view or the other, and by what noise alone allows.
BendMatrix covarianceOf(const std::vector<BendView>& views, const BendVector& weights_at, const Sums& sums,
                        const BendVector& bend) {
  BendMatrix covariance = BendMatrix::Zero();
  for (const BendView& view : views) {
    Sums others = sums;
    others.add(view, -weightOf(view, weights_at));
    const BendVector change = others.solve() - bend;
    covariance += change * change.transpose();
  }
  const auto count = static_cast<double>(views.size());
  return (count - 1) / count * covariance + sums.information.llt().solve(BendMatrix::Identity());
}

/// How many standard deviations of a Gaussian are as unlikely as this F of that many degrees of freedom (Paulson 1942).
double gaussianOf(double f, double over, double under) {
  const double root = std::cbrt(f), of_over = 2 / (9 * over), of_under = 2 / (9 * under);
  return ((1 - of_under) * root - (1 - of_over)) / std::sqrt(of_under * root * root + of_over);
}

/// Hotelling's T^2 of the estimate, as an F.
bool isSignificant(const BendVector& bend, const BendMatrix& covariance, std::size_t views) {
  const auto count = static_cast<double>(views);
  const double free = count - kBendTerms;
  const double f = bend.dot(covariance.llt().solve(bend)) * free / (kBendTerms * (count - 1));
  return gaussianOf(f, kBendTerms, free) > kSignificance;
}

/// Its expectation and covariance, if all terms come from one Gaussian, whose variance is the likeliest one.
BendEstimate shrunk(const BendVector& bend, const BendMatrix& covariance) {
  const Eigen::SelfAdjointEigenSolver<BendMatrix> axes(covariance);
  const Eigen::Array<double, kBendTerms, 1> noise = axes.eigenvalues().array().max(0);
  const BendVector along = axes.eigenvectors().transpose() * bend;
  const Eigen::Array<double, kBendTerms, 1> squares = along.array().square();
  double variance = squares.mean();
  for (int i = 0; i < kShrinkings && variance > 0; ++i) {
    const Eigen::Array<double, kBendTerms, 1> weights = (noise + variance).square().inverse();
    variance = std::max(0.0, (weights * (squares - noise)).sum() / weights.sum());
  }
  if (!(variance > 0)) return {};
  const Eigen::Array<double, kBendTerms, 1> share = variance / (noise + variance);
  return {axes.eigenvectors() * (along.array() * share).matrix(),
          axes.eigenvectors() * (noise * share).matrix().asDiagonal() * axes.eigenvectors().transpose()};
}

}  // namespace

BendEstimate estimateBend(const std::vector<BendView>& views) {
  if (views.size() < kLeastViews) return {};
  BendVector bend = BendVector::Zero(), weights_at;
  Sums sums;
  for (int i = 0; i < kReweightings; ++i) {
    weights_at = bend;
    sums = sumsOf(views, weights_at);
    bend = sums.solve();
  }
  const BendMatrix covariance = covarianceOf(views, weights_at, sums, bend);
  return isSignificant(bend, covariance, views.size()) ? shrunk(bend, covariance) : BendEstimate();
}

}  // namespace cabinet_articulation::core
