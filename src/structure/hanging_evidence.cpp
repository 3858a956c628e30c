// SPDX-License-Identifier: BSD-3-Clause
#include "structure/hanging_evidence.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "articulation/decision/candidate.h"
#include "articulation/fitting/residual_correlation.h"
#include "articulation/models/known_joint.h"
#include "articulation/observations/observation_history.h"
#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {
namespace {

/// How well a model fits, beside the freedom of its q.
struct Fit {
  double log_likelihood = -std::numeric_limits<double>::infinity();
  double parameters = 0;
  double independent = 0;  ///< poses that are independent of one another
};

double parametersOf(const LearnedModel& model) {
  const auto complexity =
      std::find_if(model.params.begin(), model.params.end(), [](const ModelParam& param) { return param.name == "complexity"; });
  return complexity == model.params.end() ? 0 : complexity->value;
}

Fit fitOf(const LearnedModel& model, const PoseSequence& poses, const ArticulationConfig& config) {
  KnownJoint joint(model, Eigen::Vector3d::Zero(), config);
  const Candidate candidate = evaluateCandidate(&joint, poses, config);
  const double share = independentShare(candidate.correlation);
  return {candidate.log_likelihood + candidate.residuals.freedom, parametersOf(model),
          std::max(1.0, share * static_cast<double>(poses.size()))};
}

std::vector<double> spacedStamps(const Track& track, const ArticulationConfig& config) {
  ObservationHistory history(config);
  if (!history.update(track)) return {};
  return history.evenlySpaced({}, static_cast<std::size_t>(config.poses_max)).stamps;
}

PoseSequence posesAt(const std::vector<double>& stamps, const Track& track, const ArticulationConfig& config) {
  Track spaced = track;
  const auto other = [&](const TrackedObservation& observation) {
    return !std::binary_search(stamps.begin(), stamps.end(), observation.stamp);
  };
  spaced.observations.erase(std::remove_if(spaced.observations.begin(), spaced.observations.end(), other),
                            spaced.observations.end());
  ObservationHistory history(config);
  return history.update(spaced) ? history.since({}, -std::numeric_limits<double>::infinity()) : PoseSequence();
}

/// The same observations on both sides, of which either leaves out others while the front rests there.
std::vector<double> commonStamps(const TrackPair& pair, const ArticulationConfig& config) {
  std::vector<double> stamps = spacedStamps(pair.world, config), common;
  const std::vector<double> relative = spacedStamps(pair.relative, config);
  std::set_union(stamps.begin(), stamps.end(), relative.begin(), relative.end(), std::back_inserter(common));
  return common;
}

/// [nats] of the better description against the other one.
double logOdds(const Fit& fit, const Fit& other, std::size_t poses) {
  const double share = fit.independent / static_cast<double>(poses);
  return share * (fit.log_likelihood - other.log_likelihood) -
         0.5 * (fit.parameters - other.parameters) * std::log(fit.independent);
}

}  // namespace

HangingEvidence compareWithWorld(const TrackPair& pair, const ArticulationConfig& config) {
  HangingEvidence evidence;
  const std::vector<LearnedModel> relative = fitAllModels(pair.relative, config);
  if (relative.empty() || !relative.front().explained) return evidence;
  evidence.rests = !relative.front().moved;
  if (!isJoint(relative.front()) || relative.front().type == JointType::kNonparametric) return evidence;
  const std::vector<double> stamps = commonStamps(pair, config);
  const PoseSequence seen = posesAt(stamps, pair.relative, config), in_world = posesAt(stamps, pair.world, config);
  if (seen.size() == 0 || seen.size() != in_world.size()) return evidence;
  const Fit hanging = fitOf(relative.front(), seen, config);
  double log_odds = std::numeric_limits<double>::infinity();
  for (const LearnedModel& model : fitAllModels(pair.world, config))
    log_odds = std::min(log_odds, logOdds(hanging, fitOf(model, in_world, config), seen.size()));
  if (!std::isfinite(log_odds)) return evidence;
  evidence.log_odds = log_odds;
  evidence.relative = relative.front();
  return evidence;
}

}  // namespace cabinet_articulation::core
