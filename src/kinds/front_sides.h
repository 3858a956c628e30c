// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "cabinet_articulation/kinds/joint_shape.h"
#include "cabinet_articulation/kinds/kinds_config.h"

namespace cabinet_articulation::core {

/// The sides of the fronts of one kind. Their logarithms are normal about a mean that is anywhere beforehand. The variance is
/// inverse gamma about the spread of `config`, as those of shapes (JointKind). Fronts of unknown size do not count.
class FrontSides {
 public:
  FrontSides(const std::vector<JointShape>& shapes, const KindsConfig& config);

  /// [nats] Log of the probability density of the sides, whatever mean and variance are.
  double logEvidence() const;

  /// [nats] Log of the density of the next front's sides. That of anyone's without a front of known size.
  double logDensity(double width, double height) const;

  /// [m] Geometric means; 0: unknown.
  double width() const { return count_ > 0 ? std::exp(sides_[0].mean) : 0; }
  double height() const { return count_ > 0 ? std::exp(sides_[1].mean) : 0; }

  /// [nats] Of any front in a room. Sides of 5 cm to 2.4 m, which are what a detector finds, are equally likely by ratio (ours).
  static double logDensityOfAny();

 private:
  struct Side {
    double mean = 0, scatter = 0;
  };
  double freedom() const { return prior_freedom_ + count_ - 1; }

  double count_ = 0;  ///< fronts of known size
  double prior_freedom_, prior_scatter_;
  std::array<Side, 2> sides_;
};

}  // namespace cabinet_articulation::core
