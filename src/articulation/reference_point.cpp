// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/articulation/reference_point.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "cabinet_articulation/articulation/arc_fit.h"
#include "cabinet_articulation/articulation/arc_start.h"

namespace cabinet_articulation::core {
namespace {

constexpr std::size_t kComparedPoses = 100;

/// (I + covariance / sigma^2)^(-1/2): a deviation weighs as much as it would with that much noise besides sigma.
Eigen::Matrix3d weightOf(const Eigen::Matrix3d& covariance, double sigma) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  const Eigen::Vector3d variances = solver.eigenvalues().cwiseMax(0) / (sigma * sigma);
  return solver.eigenvectors() * (variances.array() + 1).rsqrt().matrix().asDiagonal() * solver.eigenvectors().transpose();
}

/// The path of another point of the same front: `offset` away in the front's frame.
Arc shifted(const Arc& arc, const Eigen::Vector3d& offset) {
  Arc moved = arc;
  moved.middle = arc.middle + arc.orientation * offset;
  if (std::abs(arc.curvature) < 1e-9) return moved;
  Eigen::Vector3d inward = arc.center() - moved.middle;
  inward -= arc.axis() * arc.axis().dot(inward);
  const double radius = inward.norm();
  if (radius < 1e-6) return moved;
  const double turn = arc.curvature > 0 ? 1 : -1;
  moved.frame.col(1) = turn * inward / radius;
  moved.frame.col(0) = moved.frame.col(1).cross(arc.axis());
  moved.curvature = turn / radius;
  return moved;
}

double positionRms(const PoseSamples& samples, const Arc& arc, double limit) {
  double sum = 0;
  for (const Eigen::Vector3d& p : samples.positions) sum += std::min(arc.squaredDistance(p), limit * limit);
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

}  // namespace

PoseTrack poseTrack(const Track& track, ReferencePoint point, const ArticulationConfig& config) {
  PoseTrack poses;
  poses.has_orientation = config.use_orientation;
  bool weighted = false;
  for (const TrackedObservation& observation : track.observations) {
    const Rectangle& rectangle = observation.rectangle;
    Eigen::Isometry3d pose = rectangle.pose;
    pose.translate(point.offset(rectangle.width, rectangle.height));
    poses.stamps.push_back(observation.stamp);
    poses.poses.push_back(pose);
    weighted = weighted || !observation.covariance.isZero(0);
  }
  if (!weighted) return cleaned(poses);
  for (const TrackedObservation& observation : track.observations) {
    const Matrix6d covariance = observation.covariance.allFinite() ? observation.covariance : Matrix6d::Zero();
    // Edges err together, by a side face taken along or a hinge side hidden by its neighbour; planes do not.
    const Eigen::Vector3d normal = observation.rectangle.normal();
    const Eigen::Matrix3d in_plane = Eigen::Matrix3d::Identity() - normal * normal.transpose();
    const Eigen::Matrix3d total = covariance.topLeftCorner<3, 3>() + config.sigma_edge * config.sigma_edge * in_plane;
    poses.position_weights.push_back(weightOf(total, config.sigma_plane));
    poses.orientation_weights.push_back(weightOf(covariance.bottomRightCorner<3, 3>(), config.sigma_orientation));
  }
  return cleaned(poses);
}

ReferencePoint bestReferencePoint(const Track& track, const ReferencePoint* preferred, const ArticulationConfig& config) {
  if (track.width <= 0 || track.height <= 0) return {};
  struct Option {
    ReferencePoint point;
    double rms, radius;
  };
  std::vector<Option> options;
  Arc center_arc;
  const double limit = 3 * config.sigma_position;
  for (const ReferencePoint point :
       {ReferencePoint{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const PoseTrack poses = thinned(poseTrack(track, point, config), kComparedPoses);
    if (poses.size() < 3) return {};
    const PoseSamples samples(poses);
    const Arc start = options.empty() ? consensusArc(samples, PathShape::kCircle, config)
                                      : shifted(center_arc, point.offset(track.width, track.height));
    const ArcFit fit = fitArc(samples, PathShape::kCircle, start, config);
    if (options.empty()) center_arc = fit.arc;
    options.push_back({point, positionRms(samples, fit.arc, limit), std::abs(fit.arc.radius())});
  }
  // A point close to the hinge hardly moves: it fits well and says little.
  double largest = 0;
  for (const Option& option : options) largest = std::max(largest, option.radius);
  const Option* best = nullptr;
  for (const Option& option : options) {
    if (option.radius < 0.4 * largest) continue;
    if (!best || option.rms < best->rms) best = &option;
  }
  for (const Option& option : options)
    if (preferred && option.point.x == preferred->x && option.point.y == preferred->y && option.rms < 1.1 * best->rms)
      return *preferred;
  return best->point;
}

}  // namespace cabinet_articulation::core
