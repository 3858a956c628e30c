// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/joint_kind.h"

#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

/// Log of the multivariate gamma function, up to a constant of the dimension.
double logGamma(int dimensions, double x) {
  double sum = 0;
  for (int i = 0; i < dimensions; ++i) sum += std::lgamma(x - 0.5 * i);
  return sum;
}

}  // namespace

double ShapePrior::cost(const Eigen::VectorXd& difference) const {
  const double square = difference.dot(precision * difference);
  if (std::isinf(degrees_of_freedom)) return 0.5 * square;
  return 0.5 * (degrees_of_freedom + mean.dimensions()) * std::log1p(square / degrees_of_freedom);
}

Eigen::MatrixXd ShapePrior::covariance() const {
  const double wider = std::isinf(degrees_of_freedom) ? 1 : degrees_of_freedom / (degrees_of_freedom - 2);
  return wider * precision.inverse();
}

double ShapePrior::weight(const Eigen::VectorXd& difference) const {
  if (std::isinf(degrees_of_freedom)) return 1;
  return (degrees_of_freedom + mean.dimensions()) / (degrees_of_freedom + difference.dot(precision * difference));
}

JointKind::JointKind(std::vector<JointShape> shapes, const KindsConfig& config)
    : shapes_(std::move(shapes)), mean_(meanShape(shapes_)), sides_(shapes_, config) {
  const int d = mean_.dimensions();
  prior_freedom_ = d + 1 + config.spread_joints;
  Eigen::VectorXd variances = Eigen::VectorXd::Constant(d, config.turn_spread * config.turn_spread);
  if (mean_.turns()) variances[d - 1] = config.radius_spread * config.radius_spread;
  prior_scatter_ = Eigen::MatrixXd(config.spread_joints * variances.asDiagonal());
  scatter_ = prior_scatter_;
  for (const JointShape& shape : shapes_) {
    const Eigen::VectorXd away = difference(shape, mean_);
    scatter_ += away * away.transpose();
  }
}

ShapePrior JointKind::next() const {
  const int d = mean_.dimensions();
  ShapePrior prior;
  prior.mean = mean_;
  prior.degrees_of_freedom = freedom() - d + 1;
  const double share = prior.degrees_of_freedom * static_cast<double>(size()) / (static_cast<double>(size()) + 1);
  prior.precision = share * scatter_.inverse();
  const double half = prior.degrees_of_freedom / 2;
  prior.log_constant = std::lgamma(half + 0.5 * d) - std::lgamma(half) - 0.5 * d * std::log(M_PI * prior.degrees_of_freedom) +
                       0.5 * std::log(prior.precision.determinant());
  return prior;
}

ShapePrior JointKind::next(double width, double height) const {
  ShapePrior prior = next();
  const Eigen::Vector3d to_hinge = mean_.frame.col(1).cwiseAbs();
  const bool is_beside = to_hinge.x() > to_hinge.y();
  const double usual = is_beside ? sides_.width() : sides_.height(), side = is_beside ? width : height;
  if (mean_.turns() && usual > 0 && side > 0) prior.mean.radius *= side / usual;
  return prior;
}

double JointKind::range() const {
  std::vector<double> ranges;
  for (const JointShape& shape : shapes_)
    if (shape.range > 0) ranges.push_back(shape.range);
  return median(std::move(ranges));
}

double JointKind::logEvidence() const {
  const int d = mean_.dimensions();
  const double n = static_cast<double>(size());
  return sides_.logEvidence() - 0.5 * d * ((n - 1) * std::log(M_PI) + std::log(n)) + logGamma(d, freedom() / 2) -
         logGamma(d, prior_freedom_ / 2) + 0.5 * prior_freedom_ * std::log(prior_scatter_.determinant()) -
         0.5 * freedom() * std::log(scatter_.determinant());
}

}  // namespace cabinet_articulation::core
