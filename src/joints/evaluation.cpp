// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/evaluation.h"

#include <limits>
#include <string>
#include <utility>

#include "articulation/decision/candidate.h"
#include "articulation/models/known_joint.h"
#include "articulation/models/nonparametric_model.h"
#include "articulation/observations/observation_history.h"
#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation::core {

void requireShape(const LearnedModel& model) {
  const JointTraits& traits = modelEntry(model.type);
  const std::string kind = std::string("the model is ") + traits.name;
  const double length = model.axis.norm();
  if (traits.moves && traits.is_parametric && !isWithin(length, limits::kUnitLength))
    throw ModelError(kind + ", and its axis has the length " + std::to_string(length) + ", expected 1");
  if (traits.is_parametric) return;
  requireAtMost("poses in curve", model.curve.size(), kMostCurvePoses);
  if (!NonparametricModel::hasWay(model))
    throw ModelError(kind + ", expected " + std::to_string(PoseCurve::kLeastKnots) +
                     " poses or more in curve, and q_max above q_min");
}

LearnedModel takenAsJoint(LearnedModel model) {
  requireShape(model);
  if (!modelEntry(model.type).moves) throw ModelError("the model is rigid: it has no openings");
  model.moved = true;
  model.explained = true;
  model.doubt = 0;
  return model;
}

TrackEvaluation evaluateOnTrack(const LearnedModel& model, const Track& track, const ArticulationConfig& config) {
  requireShape(model);
  ObservationHistory history(config);
  if (!history.update(track)) throw ModelError("no pose of the track can be used");
  KnownJoint joint(model, Eigen::Vector3d::Zero(), config);
  const PoseSequence poses = history.since({}, -std::numeric_limits<double>::infinity());
  const Candidate candidate = evaluateCandidate(&joint, poses, config);
  TrackEvaluation evaluation;
  evaluation.log_likelihood = candidate.log_likelihood;
  evaluation.cost_of_freedom = candidate.residuals.freedom;
  evaluation.outlier_ratio = candidate.outlier_share;
  const auto n = static_cast<double>(track.observations.size());
  for (const TrackedObservation& observation : track.observations) {
    const Eigen::Isometry3d& pose = observation.rectangle.pose;
    evaluation.nearest.push_back(nearestConfiguration(model, pose));
    evaluation.projected.push_back(model.predict(evaluation.nearest.back().q));
    evaluation.position_error += evaluation.nearest.back().position_residual / n;
    evaluation.orientation_error += evaluation.nearest.back().orientation_residual / n;
  }
  return evaluation;
}

}  // namespace cabinet_articulation::core
