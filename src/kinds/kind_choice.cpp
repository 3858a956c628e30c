// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/kind_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

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

/// Indices of the kinds that are tried, in their order.
std::vector<std::size_t> heaviest(const std::vector<double>& weights) {
  constexpr std::size_t kMostTried = 16;  // 1 ms each (ours: more kinds of one size are rare)
  std::vector<std::size_t> indices(weights.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  std::stable_sort(indices.begin(), indices.end(), [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  indices.resize(std::min(indices.size(), kMostTried));
  std::sort(indices.begin(), indices.end());
  return indices;
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

KindWeights weightsOf(const std::vector<JointKind>& kinds, double width, double height) {
  KindWeights weights;
  const bool has_size = width > 0 && height > 0;
  const double any = FrontSides::logDensityOfAny();
  double largest = any;
  for (const JointKind& kind : kinds) {
    weights.kinds.push_back(has_size ? kind.sides().logDensity(width, height) : any);
    largest = std::max(largest, weights.kinds.back());
  }
  for (std::size_t i = 0; i < kinds.size(); ++i) weights.kinds[i] += std::log(static_cast<double>(kinds[i].size())) - largest;
  weights.any = any - largest;
  return weights;
}

KindChoice chooseKind(const std::vector<JointKind>& kinds, const KindWeights& weights, const PoseSamples& samples, double turns,
                      const KindsConfig& kinds_config, const ArticulationConfig& config) {
  const TrackNoise noise = noiseOf(samples, config);
  std::vector<Hypothesis> all = newKinds(samples, noise, turns, kinds_config.novelty, config);
  const double of_new = std::max(all[0].weight, all[1].weight);
  for (const std::size_t i : heaviest(weights.kinds)) {
    const JointKind& kind = kinds[i];
    const ShapeFit fit = fitShape(samples, noise, kind.next(), expectedArc(samples, kind.mean()), config);
    all.push_back({false, kind.mean().type, fit, fit.log_evidence + weights.kinds[i]});
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
