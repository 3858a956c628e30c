// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/joint_kinds.h"

#include <algorithm>
#include <cmath>
#include <optional>
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
  merge();
  std::size_t count = 0;
  for (const JointKind& kind : kinds_) count += kind.size();
  if (count <= kMostShapes) return;
  const auto smaller = [](const JointKind& a, const JointKind& b) { return a.size() < b.size(); };
  take(0, std::max_element(kinds_.begin(), kinds_.end(), smaller));
}

bool JointKinds::holds(const JointShape& shape) const {
  const auto is_same = [&shape](const JointShape& other) {
    return other.front == shape.front && other.type == shape.type && other.frame == shape.frame && other.radius == shape.radius &&
           other.width == shape.width && other.height == shape.height && other.range == shape.range;
  };
  return std::any_of(kinds_.begin(), kinds_.end(),
                     [&](const JointKind& kind) { return std::any_of(kind.shapes().begin(), kind.shapes().end(), is_same); });
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
  const KindWeights weights = weightsOf(kinds_, track.width, track.height);
  const KindChoice choice = chooseKind(kinds_, weights, *samples, turns / (slides + turns), config_, config);
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
