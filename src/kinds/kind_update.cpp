// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/kind_update.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "kinds/kind_description.h"

namespace cabinet_articulation::core {
namespace {

/// The own estimate.
struct Estimate {
  const LearnedModel& joint;
  JointShape shape;
};

/// [nats] Log of the density of the estimate if its joint is normal about `mean`.
double logDensity(const Estimate& own, const JointShape& mean, const Eigen::MatrixXd& spread) {
  const Eigen::VectorXd away = difference(own.shape, mean);
  const Eigen::MatrixXd covariance = shapeCovariance(own.joint, mean) + spread;
  return -0.5 * (away.dot(covariance.ldlt().solve(away)) + std::log(covariance.determinant()) +
                 static_cast<double>(away.size()) * std::log(2 * M_PI));
}

Eigen::MatrixXd squaresOf(const Eigen::VectorXd& sigmas) { return sigmas.cwiseAbs2().asDiagonal(); }

/// Hinges at one of the sides, and anywhere.
double densityOfAnyDoor(const Estimate& own, const FurniturePrior& prior) {
  constexpr double kAtASide = 0.9;  // share of the doors (ours: most)
  double sum = 0;
  for (const Eigen::Vector3d& hinge :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0, -1, 0)}) {
    JointShape door = own.shape;
    door.frame = arcFrame(Eigen::Vector3d::UnitZ(), hinge);
    const double side = hinge.x() != 0 ? own.shape.width : own.shape.height;
    if (side > 0) door.radius = side / 2;
    const double spread = prior.sigma_hinge / door.radius;
    sum += kAtASide / 4 *
           std::exp(logDensity(
               own, door,
               squaresOf(Eigen::Vector4d(prior.direction_spread, prior.direction_spread, prior.direction_spread, spread))));
  }
  const double all_rotations = 8 * M_PI * M_PI;
  const double away = std::log(own.shape.radius / prior.door_radius) / prior.door_radius_spread;
  return sum + (1 - kAtASide) / all_rotations * std::exp(-0.5 * away * away) / (std::sqrt(2 * M_PI) * prior.door_radius_spread);
}

/// Along the normal, along a side, and anywhere.
double densityOfAnyDrawer(const Estimate& own, const FurniturePrior& prior) {
  const Eigen::MatrixXd spread = squaresOf(Eigen::Vector2d::Constant(prior.direction_spread));
  const auto along = [&](const Eigen::Vector3d& direction) {
    JointShape drawer = own.shape;
    drawer.frame = arcFrame(direction, Eigen::Vector3d::Zero());
    return std::exp(logDensity(own, drawer, spread));
  };
  double sides = 0;
  for (const double sign : {-1.0, 1.0}) sides += along(sign * Eigen::Vector3d::UnitX()) + along(sign * Eigen::Vector3d::UnitY());
  const double rest = std::max(0.0, 1 - prior.drawer_share - prior.sliding_share);
  return prior.drawer_share * along(Eigen::Vector3d::UnitZ()) + prior.sliding_share / 4 * sides + rest / (4 * M_PI);
}

}  // namespace

LearnedModel updatedByKinds(const LearnedModel& joint, const std::vector<JointKind>& kinds, const KindWeights& weights,
                            const KindsConfig& config, const FurniturePrior& prior) {
  if (!hasShape(joint)) return joint;
  const Estimate own{joint, shapeOf(joint, joint.origin.linear())};
  const double of_new = config.novelty * (own.shape.turns() ? densityOfAnyDoor(own, prior) : densityOfAnyDrawer(own, prior));
  double sum = of_new, most = 0;
  const JointKind* best = nullptr;
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i].mean().type != joint.type) continue;
    const ShapePrior next = kinds[i].next(joint.width, joint.height);
    const double weight = std::exp(weights.kinds[i] + logDensity(own, next.mean, next.covariance()));
    sum += weight;
    if (weight <= most) continue;
    most = weight;
    best = &kinds[i];
  }
  if (best == nullptr || most <= sum / 2) return joint;
  const ShapePrior next = best->next(joint.width, joint.height);
  const Eigen::MatrixXd spread = next.covariance();
  const Eigen::MatrixXd gain = spread * (spread + shapeCovariance(joint, next.mean)).inverse();
  LearnedModel updated = joint;
  describe(movedBy(next.mean, gain * difference(own.shape, next.mean)), spread - gain * spread, &updated);
  if (updated.axis.dot(joint.axis) < 0) updated.axis = -updated.axis;
  for (double LearnedModel::*const q : {&LearnedModel::q, &LearnedModel::q_min, &LearnedModel::q_max})
    updated.*q = updated.configuration(joint.predict(joint.*q));
  if (joint.closed_known) updated.q_closed = updated.configuration(joint.predict(joint.q_closed));
  return updated;
}

}  // namespace cabinet_articulation::core
