// SPDX-License-Identifier: BSD-3-Clause
#include "scores/prediction_error.h"

#include <algorithm>
#include <cmath>

#include "articulation/models/model_registry.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kBeyond = 4;  ///< openings that were never seen, as a multiple of the range that was
constexpr int kSteps = 200;
constexpr double kPrecision = 1e-5;                               ///< [m or rad]
constexpr double kSigmaPosition = 0.01, kSigmaOrientation = 0.1;  ///< of Eq. (9), as in the original release

/// The least of a grid of q, then of a ternary search around it.
template <class Cost>
double minimize(const Cost& cost, double from, double to, int steps) {
  const double step = (to - from) / steps;
  double best = from, least = cost(from);
  for (int i = 1; i <= steps; ++i) {
    const double value = cost(from + i * step);
    if (value >= least) continue;
    least = value;
    best = from + i * step;
  }
  double low = best - step, high = best + step;
  while (high - low > kPrecision) {
    const double third = (high - low) / 3;
    if (cost(low + third) < cost(high - third))
      high -= third;
    else
      low += third;
  }
  return (low + high) / 2;
}

/// The model's prediction that explains `seen` best, as a rectangle. Asks nothing of the model but its prediction, so that it
/// serves every type of joint.
Rectangle bestPrediction(const LearnedModel& model, const Rectangle& seen, bool with_orientation) {
  const auto predict = [&](double q) { return Rectangle{model.predict(q), seen.width, seen.height}; };
  if (!modelEntry(model.type).moves) return predict(0);
  const double span = std::max(model.q_max - model.q_min, 1e-6);
  const auto offset = [&](double q) { return (model.predict(q).translation() - seen.center()).norm() / kSigmaPosition; };
  const double q = minimize(offset, model.q_min - kBeyond * span, model.q_max + kBeyond * span, kSteps);
  if (!with_orientation) return predict(q);
  // Which of its eight descriptions the front has does not change nearby.
  const Rectangle described = alignDescription(seen, predict(q), true);
  const auto misfit = [&](double near_q) {
    return std::hypot(offset(near_q), angleBetween(model.predict(near_q), described.pose) / kSigmaOrientation);
  };
  const double window = span / 4;
  return predict(minimize(misfit, q - window, q + window, kSteps / 10));
}

}  // namespace

PredictionError predictionError(const LearnedModel& model, const std::vector<ReferencePose>& truth, bool with_orientation) {
  PredictionError error;
  for (const ReferencePose& reference : truth) {
    const Rectangle predicted = bestPrediction(model, reference.rectangle, with_orientation);
    const double distance = (predicted.center() - reference.rectangle.center()).norm();
    error.position += distance / truth.size();
    error.position_max = std::max(error.position_max, distance);
    error.orientation += angleBetween(predicted.pose, alignDescription(reference.rectangle, predicted, true).pose) / truth.size();
  }
  return error;
}

}  // namespace cabinet_articulation::core::evaluation
