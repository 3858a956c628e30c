// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/decision/model_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "articulation/decision/systematic_error.h"
#include "articulation/fitting/residual_correlation.h"
#include "articulation/models/model_registry.h"
#include "geometry/logistic.h"

namespace cabinet_articulation::core {
namespace {

/// Share of all joints that one must have to be told from a few poses.
constexpr double kSureOfJoint = 0.75;

/// Probability of a motion that is evident from a few poses (few enough for their likelihood to say little).
constexpr double kEvident = 0.99;

/// [nats] By which a joint that is no plausible one must be better to be believed in.
constexpr double kImplausible = 5;

/// [nats] Log of the odds of a model against a simpler one, for residuals of which only as many count as are independent. What it
/// has more of parameters says how it moves, of which rest tells nothing (the penalty of the Bayesian information criterion).
double advantage(const Candidate& candidate, const Candidate& simpler, const PoseSequence& track) {
  const double independent = independentShare(candidate.correlation);
  const ModelResiduals& seen = candidate.residuals;
  const double informative = informativePoses(seen.q, seen.q_min, seen.q_max);
  const int parameters = candidate.model->complexity(track.has_orientation) - simpler.model->complexity(track.has_orientation);
  return independent * (candidate.cautious_log_likelihood - simpler.cautious_log_likelihood) -
         0.5 * parameters * std::log(std::max(1.0, independent * informative));
}

/// What the candidates are to one another; null where there is none.
struct Roles {
  const Candidate* still = nullptr;
  const Candidate* moving = nullptr;  ///< the joint that explains a motion best
  const Candidate* free = nullptr;    ///< a curve of any shape
};

/// Puts a joint's evidence on one scale with that of a simpler one, to which `added_before` was added. Adds what independent
/// residuals say, as far as it is no systematic error, and returns that.
double addIndependentEvidence(Candidate* candidate, const Candidate& simpler, double added_before, const PoseSequence& track,
                              const ArticulationConfig& config) {
  candidate->evidence += added_before;
  const double turn_min = track.orientation_weights.empty() ? config.turn_min : 0;
  const bool bends =
      bowOfPath(*candidate) >= config.sagitta_min || (track.has_orientation && turnAlongPath(*candidate) >= turn_min);
  if (!bends) candidate->evidence = std::min(candidate->evidence, simpler.evidence);
  // A sequence forgives noise that is worse with the more complex model, and takes steady turning for slow noise.
  const double difference = independentShare(candidate->correlation) * (candidate->log_likelihood - simpler.log_likelihood);
  const double added = track.has_orientation ? difference : std::min(0.0, difference);
  candidate->evidence += added;
  const double largest =
      std::min(candidate->model->largestAdvantage(), largestAdvantageOfTurning(*candidate, simpler, track, config));
  const double excess = std::max(0.0, candidate->evidence - (simpler.evidence + largest));
  candidate->evidence -= excess;
  if (candidate->model->traits().turns && !simpler.model->traits().turns && std::isfinite(candidate->evidence)) {
    const double largest_loss = largestAdvantageOfStraightness(simpler, track, config);
    candidate->evidence = std::max(candidate->evidence, simpler.evidence + candidate->model->logPrior() - largest_loss);
  }
  return added - excess;
}

/// A joint that does not explain the poses, or cannot be where it is, loses to one that does and can.
void preferPlausible(Candidate* candidate, const Candidate& simpler, const ArticulationConfig& config) {
  if (explains(simpler, config) && !explains(*candidate, config))
    candidate->evidence = std::min(candidate->evidence, simpler.evidence - kImplausible);
  if (!explains(simpler, config) && explains(*candidate, config))
    candidate->evidence = std::max(candidate->evidence, simpler.evidence + kImplausible);
  if (!candidate->plausible && candidate->evidence < simpler.evidence + kImplausible)
    candidate->evidence = std::min(candidate->evidence, simpler.evidence - kImplausible);
}

/// Also adds to the evidence of joints what their independent residuals say.
Roles assignRoles(std::vector<Candidate>* candidates, const PoseSequence& track, const ArticulationConfig& config) {
  Roles roles;
  double added_before = 0;  // [nats] to the evidence of roles.moving
  for (Candidate& candidate : *candidates) {
    if (!candidate.model->moves()) {
      roles.still = &candidate;
      continue;
    }
    if (!candidate.model->isParametric()) {
      roles.free = &candidate;
      continue;
    }
    double added = 0;
    if (roles.moving) {
      added = addIndependentEvidence(&candidate, *roles.moving, added_before, track, config);
      preferPlausible(&candidate, *roles.moving, config);
      if (candidate.evidence <= roles.moving->evidence) continue;
    }
    roles.moving = &candidate;
    added_before += added;
  }
  if (!roles.moving) std::swap(roles.moving, roles.free);
  return roles;
}

/// Is it more probable than all other joints together?
bool isSureOfJoint(const std::vector<Candidate>& candidates, const Candidate& best) {
  double sum = 0;
  for (const Candidate& candidate : candidates)
    if (candidate.model->moves() && candidate.model->isParametric()) sum += std::exp(candidate.evidence - best.evidence);
  return sum < 1 / kSureOfJoint;
}

/// Probability that the front moved, as `best` says.
double probabilityOfMotion(const std::vector<Candidate>& candidates, const Roles& roles, const Candidate* best,
                           const PoseSequence& track, const MotionDetector* detector, double log_odds,
                           const ArticulationConfig& config) {
  if (!best) return 0;
  if (!roles.still) return 1;
  const double odds = advantage(*best, *roles.still, track) + best->front_log_odds, moved = logistic(odds);
  if (!best->plausible) return std::min(moved, 0.5);
  // Poses that neither rest nor any path explains have moved all the same.
  const bool unexplained = track.orientation_weights.empty() && !explains(*roles.still, config) && !explains(*best, config);
  if (!detector || unexplained) return std::max(moved, kEvident);
  const double early = detector->earlyLogOdds(*best->model, best->residuals, track) + best->front_log_odds;
  if (early >= MotionDetector::kLogOdds && isSureOfJoint(candidates, *best)) return std::max(moved, logistic(early));
  return odds >= log_odds && detector->passes(*best->model, best->residuals, track) ? moved : std::min(moved, 0.5);
}

/// Index = JointType. `moved` and `beyond`: of motion, and of motion that no joint describes.
std::vector<double> probabilitiesOf(const std::vector<Candidate>& candidates, const Roles& roles, double moved, double beyond) {
  std::vector<double> probabilities(modelRegistry().size(), 0);
  const auto probability = [&probabilities](const Candidate& candidate) -> double& {
    return probabilities[static_cast<std::size_t>(candidate.model->type())];
  };
  const auto share = [&roles](const Candidate& candidate) {
    return candidate.model->moves() && &candidate != roles.free ? std::exp(candidate.evidence - roles.moving->evidence) : 0;
  };
  if (roles.still) probability(*roles.still) = 1 - moved;
  if (roles.free) probability(*roles.free) = moved * beyond;
  double sum = 0;
  for (const Candidate& candidate : candidates) sum += share(candidate);
  for (const Candidate& candidate : candidates)
    if (share(candidate) > 0) probability(candidate) = moved * (1 - beyond) * share(candidate) / sum;
  return probabilities;
}

}  // namespace

Selection selectModel(std::vector<Candidate>* candidates, const PoseSequence& track, const MotionDetector* detector,
                      double log_odds, const ArticulationConfig& config) {
  const Roles roles = assignRoles(candidates, track, config);
  const bool open = roles.free && !explains(*roles.moving, config);
  const double beyond = open ? logistic(advantage(*roles.free, *roles.moving, track)) : 0;
  const Candidate* best = beyond > 0.5 ? roles.free : roles.moving;
  const double moved = probabilityOfMotion(*candidates, roles, best, track, detector, log_odds, config);
  Selection selection;
  if (best) selection.log_odds = roles.still ? advantage(*best, *roles.still, track) : std::numeric_limits<double>::infinity();
  // Where no curve explains the motion better either, it is none of these all the same.
  const double other = open ? std::max(beyond, probabilityOfAnother(*roles.moving, config)) : beyond;
  selection.probabilities = probabilitiesOf(*candidates, roles, moved, other);
  selection.moved = best && moved > 0.5;
  selection.explained = !selection.moved || explains(*best, config);
  if (!selection.moved && roles.still) best = roles.still;
  if (best) selection.best = static_cast<std::size_t>(best - candidates->data());
  return selection;
}

}  // namespace cabinet_articulation::core
