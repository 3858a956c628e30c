// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "cabinet_articulation/kinds/kinds_config.h"
#include "kinds/front_sides.h"
#include "kinds/shape_geometry.h"

namespace cabinet_articulation::core {

/// What is expected of a joint's shape: Student's t about `mean`, in the coordinates of difference().
struct ShapePrior {
  JointShape mean;
  Eigen::MatrixXd precision;
  double degrees_of_freedom = 0;  ///< infinite: Gaussian
  double log_constant = 0;        ///< [nats] log of the density at the mean

  /// [nats] Negative log of the density `difference` away, in proportion to that at the mean.
  double cost(const Eigen::VectorXd& difference) const;
  /// Of a Gaussian that is as wide.
  Eigen::MatrixXd covariance() const;
  /// By which the precision counts there: the curvature of a Gaussian that has the same slope.
  double weight(const Eigen::VectorXd& difference) const;
};

/// Joints that have their shape in common. Shapes of a kind are normal about its mean. The mean is anywhere beforehand; the
/// covariance is inverse Wishart about the spreads of `config` (Murphy, Conjugate Bayesian analysis of the Gaussian distribution,
/// 2007, sections 8 and 9). So are the sides of their fronts.
class JointKind {
 public:
  JointKind(std::vector<JointShape> shapes, const KindsConfig& config);

  const std::vector<JointShape>& shapes() const { return shapes_; }
  const JointShape& mean() const { return mean_; }
  std::size_t size() const { return shapes_.size(); }

  /// The next joint of this kind.
  ShapePrior next() const;

  /// The same for a front of this size: hinges of a kind sit at the same share of the side across. A side of 0 is unknown.
  ShapePrior next(double width, double height) const;

  /// Of the fronts.
  const FrontSides& sides() const { return sides_; }

  /// [m; where it turns rad] Median of how far they were seen to open; 0: unknown.
  double range() const;

  /// [nats] Log of the probability density of shapes and sides, whatever means and covariances are, per density of the place of
  /// the shapes' mean.
  double logEvidence() const;

 private:
  double freedom() const { return prior_freedom_ + static_cast<double>(size()) - 1; }

  std::vector<JointShape> shapes_;
  JointShape mean_;
  FrontSides sides_;
  double prior_freedom_;
  Eigen::MatrixXd prior_scatter_, scatter_;
};

}  // namespace cabinet_articulation::core
