// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/joint_kinds.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "articulation/observations/observation_history.h"
#include "kinds/kind_choice.h"
#include "kinds/kind_description.h"
#include "kinds/kind_update.h"

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
  JointShape shape = shapeOf(joint, start);
  shape.front = 0;  // logs have no ids
  add(shape);
  return true;
}

void JointKinds::add(const JointShape& shape) {
  if (shape.front != 0) remove(shape.front);
  kinds_.emplace_back(std::vector<JointShape>{shape}, config_);
  settle(kinds_.size() - 1);
  std::size_t count = 0;
  for (const JointKind& kind : kinds_) count += kind.size();
  if (count <= kMostShapes) return;
  const auto smaller = [](const JointKind& a, const JointKind& b) { return a.size() < b.size(); };
  take(0, std::max_element(kinds_.begin(), kinds_.end(), smaller));
}

bool JointKinds::holds(const JointShape& shape) const {
  const std::optional<JointShape> known = jointOf(shape.front);
  return known && isSame(*known, shape);
}

std::optional<JointShape> JointKinds::jointOf(std::uint32_t front) const {
  if (front == 0) return std::nullopt;
  for (const JointKind& kind : kinds_)
    for (const JointShape& shape : kind.shapes())
      if (shape.front == front) return shape;
  return std::nullopt;
}

/// Takes one joint out of a kind.
void JointKinds::take(std::size_t i, std::vector<JointKind>::iterator kind) {
  std::vector<JointShape> left = kind->shapes();
  left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
  if (left.empty())
    kinds_.erase(kind);
  else
    *kind = JointKind(std::move(left), config_);
}

void JointKinds::remove(std::uint32_t front) {
  for (auto kind = kinds_.begin(); kind != kinds_.end(); ++kind)
    for (std::size_t i = 0; i < kind->size(); ++i)
      if (kind->shapes()[i].front == front) return take(i, kind);
}

void JointKinds::disown(std::uint32_t front) {
  for (JointKind& kind : kinds_) {
    std::vector<JointShape> shapes = kind.shapes();
    const auto own =
        std::find_if(shapes.begin(), shapes.end(), [front](const JointShape& shape) { return shape.front == front; });
    if (own == shapes.end()) continue;
    own->front = 0;
    kind = JointKind(std::move(shapes), config_);
  }
}

JointKinds JointKinds::without(std::uint32_t front) const {
  JointKinds others = *this;
  others.remove(front);
  return others;
}

std::vector<JointShape> JointKinds::shapes() const {
  std::vector<JointShape> shapes;
  for (const JointKind& kind : kinds_) shapes.insert(shapes.end(), kind.shapes().begin(), kind.shapes().end());
  return shapes;
}

/// [nats] A kind's evidence, with its part of the Chinese restaurant process.
double JointKinds::score(const JointKind& kind) const {
  const ShapePrior mean = unknownKind(kind.mean(), prior_);
  return kind.logEvidence() + mean.log_constant - mean.cost(difference(kind.mean(), mean.mean)) + std::log(config_.novelty) +
         std::lgamma(static_cast<double>(kind.size()));
}

/// Merges a kind with the one that gains most by it, until none does. The others among themselves are as they were.
void JointKinds::settle(std::size_t i) {
  while (true) {
    const double own = score(kinds_[i]);
    double most = 0;
    std::size_t with = i;
    std::optional<JointKind> best;
    for (std::size_t other = 0; other < kinds_.size(); ++other) {
      if (other == i || kinds_[other].mean().type != kinds_[i].mean().type) continue;
      std::vector<JointShape> shapes = kinds_[std::min(i, other)].shapes();
      const std::vector<JointShape>& later = kinds_[std::max(i, other)].shapes();
      shapes.insert(shapes.end(), later.begin(), later.end());
      JointKind merged(std::move(shapes), config_);
      const double gain = score(merged) - own - score(kinds_[other]);
      if (gain <= most) continue;
      most = gain;
      with = other;
      best = std::move(merged);
    }
    if (!best) return;
    kinds_[std::min(i, with)] = std::move(*best);
    kinds_.erase(kinds_.begin() + static_cast<std::ptrdiff_t>(std::max(i, with)));
    i = std::min(i, with);
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
  const KindWeights weights = weightsOf(kinds_, track.width, track.height);
  const KindChoice choice = chooseKind(kinds_, weights, *samples, turns / (slides + turns), config_, config);
  if (choice.is_new) return learned;
  if (!learned.moved) {
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

LearnedModel JointKinds::update(const LearnedModel& learned) const {
  return updatedByKinds(learned, kinds_, weightsOf(kinds_, learned.width, learned.height), config_, prior_);
}

LearnedModel JointKinds::expect(const LearnedModel& resting, std::size_t at_rest) const {
  if (kinds_.empty() || !(resting.width > 0 && resting.height > 0)) return resting;
  const KindWeights weights = weightsOf(kinds_, resting.width, resting.height);
  const double others = config_.novelty + static_cast<double>(at_rest) * std::exp(weights.any);
  double sum = others;
  for (const double weight : weights.kinds) sum += std::exp(weight);
  const auto best = std::max_element(weights.kinds.begin(), weights.kinds.end());
  if (std::exp(*best) <= sum / 2) return resting;
  LearnedModel expected = resting;
  for (double& probability : expected.probabilities) probability = 0;
  probabilityOf(JointType::kRigid, &expected) = others / sum;
  for (std::size_t i = 0; i < kinds_.size(); ++i)
    probabilityOf(kinds_[i].mean().type, &expected) += std::exp(weights.kinds[i]) / sum;
  expected.observed = false;
  describe(kinds_[static_cast<std::size_t>(best - weights.kinds.begin())], &expected);
  return expected;
}

}  // namespace cabinet_articulation::core
