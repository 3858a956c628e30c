// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/learner/model_description.h"

#include <cmath>

#include "articulation/learner/range_ends.h"
#include "cabinet_articulation/geometry/rectangle.h"

namespace cabinet_articulation::core {
namespace {

void describeGeometry(const Candidate& candidate, const Eigen::Vector3d& reference, LearnedModel* learned) {
  const ArticulationModel& model = *candidate.model;
  learned->origin = model.predict(0);
  learned->origin.translate(-reference);
  learned->curve = model.curve(candidate.residuals.q_min, candidate.residuals.q_max);
  for (Eigen::Isometry3d& pose : learned->curve) pose.translate(-reference);
  const JointGeometry geometry = model.geometry();
  learned->axis = geometry.axis;
  learned->pitch = geometry.pitch;
  if (geometry.radius == 0) return;
  const Eigen::Vector3d away = learned->origin.translation() - geometry.axis_point;
  learned->axis_point = geometry.axis_point + geometry.axis * geometry.axis.dot(away);
  learned->radius = (learned->origin.translation() - learned->axis_point).norm();
}

void describeRange(const Candidate& candidate, const std::vector<double>& stamps, LearnedModel* learned) {
  const ModelResiduals& residuals = candidate.residuals;
  const RangeEnds ends = seenEnds(residuals.q, stamps, residuals.q_min, residuals.q_max);
  learned->q_min = residuals.q_min;
  learned->q_max = residuals.q_max;
  learned->q_min_is_end = candidate.model->moves() && ends.min;
  learned->q_max_is_end = candidate.model->moves() && ends.max;
}

void describeFit(const Candidate& candidate, const PoseSequence& track, const ArticulationConfig& config, LearnedModel* learned) {
  const ModelResiduals& residuals = candidate.residuals;
  const double n = static_cast<double>(residuals.q.size());
  for (std::size_t i = 0; i < residuals.q.size(); ++i) {
    learned->position_error += residuals.position[i].norm() / n;
    // Not as they are weighted: well observed orientations count several times.
    if (track.has_orientation)
      learned->orientation_error += angleBetween(track.poses[i], candidate.model->predict(residuals.q[i])) / n;
  }
  learned->params = candidate.model->parameters();
  const auto add = [learned](const char* name, double value, ModelParam::Kind kind = ModelParam::kEval) {
    learned->params.push_back({name, value, kind});
  };
  const double parameters = candidate.model->complexity(track.has_orientation);
  add("sigma_position", config.sigma_position, ModelParam::kPrior);
  add("sigma_orientation", config.sigma_orientation, ModelParam::kPrior);
  add("complexity", parameters);
  add("dofs", candidate.model->moves() ? 1 : 0);
  add("samples", n);
  add("q_min[0]", residuals.q_min);
  add("q_max[0]", residuals.q_max);
  add("avg_error_position", learned->position_error);
  add("avg_error_orientation", learned->orientation_error);
  add("outlier_ratio", candidate.outlier_share);
  add("avg_deviation", candidate.mean_deviation);
  add("loglikelihood", candidate.log_likelihood);
  add("evidence", candidate.evidence);
  add("correlation", candidate.correlation);
  add("bic", -2 * candidate.log_likelihood + parameters * std::log(n));
}

}  // namespace

void describeJoint(const Candidate& candidate, const PoseSequence& track, const Eigen::Vector3d& reference,
                   const ArticulationConfig& config, LearnedModel* learned) {
  describeGeometry(candidate, reference, learned);
  describeRange(candidate, track.stamps, learned);
  if (learned->moved || !candidate.model->moves())
    learned->covariance = candidate.model->covariance(track, learned->origin.translation(), candidate.memory);
  describeFit(candidate, track, config, learned);
}

}  // namespace cabinet_articulation::core
