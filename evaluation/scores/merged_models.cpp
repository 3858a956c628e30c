// SPDX-License-Identifier: BSD-3-Clause
#include "scores/merged_models.h"

#include <cmath>
#include <limits>
#include <utility>

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kOutlierDistance = 1.96;  ///< [standard deviations] in each of two dimensions

/// [nats] Of a pose at the configuration that explains it best.
double logLikelihood(const LearnedModel& model, const Eigen::Isometry3d& pose, const ArticulationConfig& config) {
  const Eigen::Isometry3d predicted = model.predict(model.configuration(pose));
  double inlier = -0.5 * (predicted.translation() - pose.translation()).squaredNorm() / std::pow(config.sigma_position, 2);
  double constant = -std::log(2 * M_PI * config.sigma_position);
  if (config.use_orientation) {
    inlier -= 0.5 * std::pow(angleBetween(predicted, pose) / config.sigma_orientation, 2);
    constant -= std::log(config.sigma_orientation);
  }
  return constant + std::log(std::exp(inlier) + std::exp(-kOutlierDistance * kOutlierDistance));
}

}  // namespace

MergedModels::Model MergedModels::fitted(std::vector<TrackedObservation> poses) const {
  Track track;
  track.observations = std::move(poses);
  for (std::size_t i = 0; i < track.observations.size(); ++i) track.observations[i].stamp = static_cast<double>(i);
  track.width = track.observations.front().rectangle.width;
  track.height = track.observations.front().rectangle.height;
  Model best;
  best.bic = std::numeric_limits<double>::infinity();
  for (const LearnedModel& joint : fitAllModels(track, config_)) {
    if (joint.type != JointType::kPrismatic && joint.type != JointType::kRotational) continue;
    const int parameters = joint.type == JointType::kPrismatic ? 8 : 9;
    double bic = parameters * std::log(static_cast<double>(track.observations.size()));
    for (const TrackedObservation& observation : track.observations)
      bic -= 2 * logLikelihood(joint, observation.rectangle.pose, config_);
    if (bic < best.bic) best = {{}, joint, bic};
  }
  best.poses = track.observations;
  return best;
}

MergedModels::Choice MergedModels::choose(const Track& track) const {
  const Eigen::Isometry3d to_start = track.observations.front().rectangle.pose.inverse();
  std::vector<TrackedObservation> poses = track.observations;
  for (TrackedObservation& observation : poses) observation.rectangle.pose = to_start * observation.rectangle.pose;
  Choice best{models_.size(), fitted(poses)};
  double least = best.model.bic;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    std::vector<TrackedObservation> all = models_[i].poses;
    all.insert(all.end(), poses.begin(), poses.end());
    Model merged = fitted(std::move(all));
    const double more = merged.bic - models_[i].bic;
    if (!(more < least)) continue;
    least = more;
    best = {i, std::move(merged)};
  }
  return best;
}

void MergedModels::store(const Track& track) {
  Choice choice = choose(track);
  if (choice.index == models_.size()) models_.emplace_back();
  models_[choice.index] = std::move(choice.model);
}

LearnedModel MergedModels::modelOf(const Track& track) const {
  const Eigen::Isometry3d& start = track.observations.front().rectangle.pose;
  LearnedModel joint = choose(track).model.joint;
  joint.origin = start * joint.origin;
  joint.axis = start.linear() * joint.axis;
  joint.axis_point = start * joint.axis_point;
  return joint;
}

}  // namespace cabinet_articulation::core::evaluation
