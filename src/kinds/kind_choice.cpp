// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/kind_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cabinet_articulation::core {
namespace {

struct Hypothesis {
  bool is_new;
  JointType type;
  ShapeFit fit;
  double weight;  ///< [nats]
};

/// The two ways a joint of a new kind may move.
std::vector<Hypothesis> newKinds(const PoseSamples& samples, const TrackNoise& noise, double turns, double novelty,
                                 const ArticulationConfig& config) {
  constexpr double kLeast = 1e-9;  // a type is never ruled out
  const Eigen::Matrix3d start = samples.orientations.front().toRotationMatrix();
  std::vector<Hypothesis> hypotheses;
  for (const JointType type : {JointType::kPrismatic, JointType::kRotational}) {
    const bool is_turn = type == JointType::kRotational;
    const Arc& path = is_turn ? noise.circle : noise.line;
    JointShape direction;
    direction.type = type;
    direction.frame = start.transpose() * path.frame;
    const ShapeFit fit = fitShape(samples, noise, unknownKind(direction, config.prior), path, config);
    const double share = std::max(kLeast, is_turn ? turns : 1 - turns);
    hypotheses.push_back({true, type, fit, fit.log_evidence + std::log(novelty * share)});
  }
  return hypotheses;
}

}  // namespace

ShapePrior unknownKind(const JointShape& direction, const FurniturePrior& prior) {
  const int d = direction.dimensions();
  ShapePrior unknown;
  unknown.mean = direction;
  unknown.degrees_of_freedom = std::numeric_limits<double>::infinity();
  unknown.precision = Eigen::MatrixXd::Identity(d, d) / (M_PI * M_PI);
  // One over the volume of all directions, or of all rotations.
  unknown.log_constant = direction.turns() ? -std::log(8 * M_PI * M_PI) : -std::log(4 * M_PI);
  if (!direction.turns()) return unknown;
  unknown.mean.radius = prior.door_radius;
  unknown.precision(d - 1, d - 1) = 1 / (prior.door_radius_spread * prior.door_radius_spread);
  unknown.log_constant -= 0.5 * std::log(2 * M_PI) + std::log(prior.door_radius_spread);
  return unknown;
}

KindChoice chooseKind(const std::vector<JointKind>& kinds, const PoseSamples& samples, double turns,
                      const KindsConfig& kinds_config, const ArticulationConfig& config) {
  const TrackNoise noise = noiseOf(samples, config);
  std::vector<Hypothesis> all = newKinds(samples, noise, turns, kinds_config.novelty, config);
  const double of_new = std::max(all[0].weight, all[1].weight);
  for (const JointKind& kind : kinds) {
    const ShapeFit fit = fitShape(samples, noise, kind.next(), expectedArc(samples, kind.mean()), config);
    all.push_back({false, kind.mean().type, fit, fit.log_evidence + std::log(static_cast<double>(kind.size()))});
  }
  const Hypothesis& best =
      *std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.weight < b.weight; });
  double sum = 0, sum_turns = 0;
  for (const Hypothesis& hypothesis : all) {
    const double share = std::exp(hypothesis.weight - best.weight);
    sum += share;
    if (hypothesis.type == JointType::kRotational) sum_turns += share;
  }
  return {best.is_new, best.type, best.fit.arc, sum_turns / sum, best.weight - of_new};
}

}  // namespace cabinet_articulation::core
