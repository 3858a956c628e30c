// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstddef>
#include <vector>

#include "articulation/learner/front_learner.h"
#include "articulation/learner/model_description.h"

namespace cabinet_articulation::core {

std::vector<LearnedModel> FrontLearner::candidates() const {
  std::vector<LearnedModel> all;
  for (const Candidate& candidate : candidates_) all.push_back(describe(candidate));
  const auto probability = [](const LearnedModel& model) { return model.probabilities[static_cast<std::size_t>(model.type)]; };
  std::stable_sort(all.begin(), all.end(),
                   [&](const LearnedModel& a, const LearnedModel& b) { return probability(a) > probability(b); });
  return all;
}

LearnedModel FrontLearner::describe(const Candidate& candidate) const {
  LearnedModel learned;
  learned.id = front_.id;
  learned.stamp = poses_.stamps.back();
  learned.type = candidate.model->type();
  learned.probabilities = selection_.probabilities;
  learned.moved = selection_.moved;
  learned.explained = selection_.explained;
  learned.width = front_.width;
  learned.height = front_.height;
  learned.hollow = front_.hollow;
  learned.observations = static_cast<int>(observations_.size());
  learned.q = candidate.model->configuration(poses_.poses.back());
  describeJoint(candidate, spaced_, reference_.offset(front_.width, front_.height), config_, &learned);
  return learned;
}

/// The joint as it was found last, with the front where it is now.
LearnedModel FrontLearner::describeKnownJoint() const {
  LearnedModel learned = *joint_;
  learned.id = front_.id;
  learned.hollow = learned.hollow || front_.hollow;
  learned.stamp = poses_.stamps.back();
  learned.q = knownJoint().configuration(poses_.poses.back());
  learned.observations = static_cast<int>(observations_.size());
  return learned;
}

/// What a joint that was given up came from is left out of fits. It tells all the same whether one joint makes all that was seen
/// of the front. By time a long rest may hide it, along the way a fast motion may: one that tells is enough.
void FrontLearner::weighWhatIsLeftOut() {
  if (learned_.type == JointType::kNonparametric) return;
  const auto count = static_cast<std::size_t>(config_.poses_max);
  KnownJoint known(learned_, reference_.offset(front_.width, front_.height), config_);
  const auto probability_of_another = [&](PoseSequence all) {
    all.outline = poses_.outline;
    return probabilityOfAnother(evaluateCandidate(&known, all, config_), config_);
  };
  const double other = std::max(probability_of_another(observations_.withLeftOut(reference_, count)),
                                probability_of_another(observations_.alongWholeWay(reference_, count)));
  if (std::none_of(models_.begin(), models_.end(),
                   [](const auto& model) { return model->type() == JointType::kNonparametric; })) {
    // A type that joint_types leaves out is never told.
    learned_.explained = learned_.explained && other < 1 - other;
    return;
  }
  double of_joints = 0;
  for (const auto& model : models_) {
    if (!model->moves() || !model->isParametric()) continue;
    double& probability = learned_.probabilities[static_cast<std::size_t>(model->type())];
    of_joints += probability;
    probability *= 1 - other;
  }
  learned_.probabilities[static_cast<std::size_t>(JointType::kNonparametric)] += other * of_joints;
}

}  // namespace cabinet_articulation::core
