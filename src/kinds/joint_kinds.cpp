// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/joint_kinds.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "articulation/observations/observation_history.h"
#include "kinds/kind_choice.h"

namespace cabinet_articulation::core {
namespace {

/// The poses of the front's centre, as fits take them.
std::optional<PoseSamples> samplesOf(const Track& track, const ArticulationConfig& config) {
  ObservationHistory history(config);
  if (!history.update(track)) return std::nullopt;
  PoseSequence poses = history.evenlySpaced({}, static_cast<std::size_t>(config.poses_max));
  poses.hinge.sigma = 0;  // kinds know more of it
  return PoseSamples(poses);
}

double& probabilityOf(JointType type, LearnedModel* model) { return model->probabilities.at(static_cast<std::size_t>(type)); }

/// Puts the joint of `arc`, whose middle is where the front was first seen, in place of what was learned.
void describe(const Arc& arc, JointType type, const PoseSamples& samples, LearnedModel* learned) {
  const bool turns = type == JointType::kRotational;
  learned->type = type;
  learned->origin.translation() = arc.middle;
  learned->origin.linear() = samples.has_orientation ? arc.orientation : samples.orientations.front().toRotationMatrix();
  learned->axis = turns ? arc.axis() : arc.tangent();
  learned->axis_point = turns ? arc.center() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  learned->radius = turns ? arc.radius() : 0;
  learned->pitch = 0;
  learned->curve.clear();
  learned->params.clear();
  learned->q_min = learned->q_max = 0;
  learned->q_min_is_end = learned->q_max_is_end = false;
  for (const Eigen::Vector3d& position : samples.positions) {
    learned->q = (turns ? arc.curvature : 1) * arc.arcLength(position);
    learned->q_min = std::min(learned->q_min, learned->q);
    learned->q_max = std::max(learned->q_max, learned->q);
  }
}

}  // namespace

JointKinds::JointKinds(const KindsConfig& config, const FurniturePrior& prior) : config_(config), prior_(prior) {
  checkConfig(config);
}

bool JointKinds::add(const LearnedModel& joint, const Track& track, const ArticulationConfig& config) {
  if (!joint.moved || !joint.explained || !hasShape(joint)) return false;
  const std::optional<PoseSamples> samples = samplesOf(track, config);
  if (!samples) return false;
  const Eigen::Matrix3d start =
      samples->has_orientation ? joint.origin.linear() : samples->orientations.front().toRotationMatrix();
  kinds_.emplace_back(std::vector<JointShape>{shapeOf(joint, start)}, config_);
  merge();
  return true;
}

/// [nats] A kind's evidence, with its part of the Chinese restaurant process.
double JointKinds::score(const JointKind& kind) const {
  const ShapePrior mean = unknownKind(kind.mean(), prior_);
  return kind.logEvidence() + mean.log_constant - mean.cost(difference(kind.mean(), mean.mean)) + std::log(config_.novelty) +
         std::lgamma(static_cast<double>(kind.size()));
}

/// Merges the two kinds whose merging gains most, until none does.
void JointKinds::merge() {
  while (true) {
    double most = 0;
    std::size_t first = 0, second = 0;
    std::optional<JointKind> best;
    for (std::size_t b = 1; b < kinds_.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) {
        if (kinds_[a].mean().type != kinds_[b].mean().type) continue;
        std::vector<JointShape> shapes = kinds_[a].shapes();
        shapes.insert(shapes.end(), kinds_[b].shapes().begin(), kinds_[b].shapes().end());
        JointKind merged(std::move(shapes), config_);
        const double gain = score(merged) - score(kinds_[a]) - score(kinds_[b]);
        if (gain <= most) continue;
        most = gain;
        first = a;
        second = b;
        best = std::move(merged);
      }
    if (!best) return;
    kinds_[first] = std::move(*best);
    kinds_.erase(kinds_.begin() + static_cast<std::ptrdiff_t>(second));
  }
}

LearnedModel JointKinds::predict(const LearnedModel& learned, const Track& track, const ArticulationConfig& config) const {
  LearnedModel predicted = learned;
  double& still = probabilityOf(JointType::kRigid, &predicted);
  double& slides = probabilityOf(JointType::kPrismatic, &predicted);
  double& turns = probabilityOf(JointType::kRotational, &predicted);
  if (kinds_.empty() || !learned.explained || still > 0.5 || slides + turns <= 0) return learned;
  const std::optional<PoseSamples> samples = samplesOf(track, config);
  if (!samples) return learned;
  const KindChoice choice = chooseKind(kinds_, *samples, turns / (slides + turns), config_, config);
  if (choice.is_new) return learned;
  if (!learned.moved) {
    constexpr double kSureOfType = 0.95;
    const double odds = std::exp(choice.advantage) / config.prior.rest_odds;
    if (odds < 1 || std::max(choice.turns, 1 - choice.turns) < kSureOfType) return learned;
    predicted.moved = true;
    const double rests = still / (still + (1 - still) * odds);
    const double more = (1 - rests) / (1 - still);
    for (double& probability : predicted.probabilities) probability *= more;
    still = rests;
  }
  const double joints = slides + turns;
  turns = joints * choice.turns;
  slides = joints - turns;
  describe(choice.arc, choice.type, *samples, &predicted);
  return predicted;
}

}  // namespace cabinet_articulation::core
