// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "articulation/paths/hinge_prior.h"
#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation::core {

/// A pose track as the learner sees it: poses of one reference point of the front.
struct PoseSequence {
  std::vector<double> stamps;  ///< [s] ascending
  std::vector<Eigen::Isometry3d> poses;
  bool has_orientation = true;  ///< false: positions only (logs of three columns)
  /// How much of a deviation counts, per pose: symmetric matrices in the track's frame. Eigenvalues are from 0 (that direction
  /// was not observed) to 1. Of orientations that are better observed than sigma_orientation says, they are larger. Empty:
  /// everything was observed. Ignored without orientation.
  std::vector<Eigen::Matrix3d> position_weights;
  std::vector<Eigen::Matrix3d> orientation_weights;
  /// [m], [rad] Standard deviation in each direction from one pose to the next, where they do not say how certain they are.
  double position_jitter = 0, orientation_jitter = 0;
  bool is_marker = false;           ///< the front's size is not known
  HingePrior hinge;                 ///< needs orientations
  std::vector<float> edge_support;  ///< share of the edges seen, per pose; not a number: not known
  /// Points of the front, in its own frame as seen from the reference point, whose motion is looked at.
  std::vector<Eigen::Vector3d> outline{Eigen::Vector3d::Zero()};

  /// 1: the pose does not follow the one before at once. Empty: all do but the first.
  std::vector<char> run_starts;

  bool startsRun(std::size_t i) const { return i == 0 || (!run_starts.empty() && run_starts[i]); }
  std::size_t size() const { return poses.size(); }
};

/// [m], [rad] Standard deviation of a pose that does not say how certain it is: at least what the configuration says.
template <class Poses>
double sigmaPosition(const Poses& poses, const ArticulationConfig& config) {
  return std::max(config.sigma_position, poses.position_jitter);
}
template <class Poses>
double sigmaOrientation(const Poses& poses, const ArticulationConfig& config) {
  return std::max(config.sigma_orientation, poses.orientation_jitter);
}

/// Standard deviations beyond which a pose or a residual is an outlier: the usual three (ours).
constexpr double kOutlierSigmas = 3;

/// [m] Distance from a path beyond which a pose is an outlier.
template <class Poses>
double outlierDistance(const Poses& poses, const ArticulationConfig& config) {
  return kOutlierSigmas * sigmaPosition(poses, config);
}

/// The poses of these indices, which ascend. run_starts are taken over as they are.
PoseSequence selected(const PoseSequence& track, const std::vector<std::size_t>& indices);

/// A pose track laid out for the fits: orientations as unit quaternions.
struct PoseSamples {
  explicit PoseSamples(const PoseSequence& track);

  bool has_orientation;
  std::vector<Eigen::Vector3d> positions;
  std::vector<Eigen::Quaterniond> orientations;
  std::vector<Eigen::Matrix3d> position_weights;
  std::vector<Eigen::Matrix3d> orientation_weights;
  std::vector<char> run_starts;  ///< one for each pose
  HingePrior hinge;
  double position_jitter, orientation_jitter;
  bool is_marker;

  std::size_t size() const { return positions.size(); }
};

/// [m] Largest distance of an axis from the observed point.
inline double radiusMax(const PoseSamples& samples, const ArticulationConfig& config) {
  return samples.is_marker ? config.marker_radius_max : config.radius_max;
}

}  // namespace cabinet_articulation::core
