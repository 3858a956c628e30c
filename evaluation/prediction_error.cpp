// SPDX-License-Identifier: BSD-3-Clause
#include "prediction_error.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kBeyond = 4;  ///< openings that were never seen, as a multiple of the range that was
constexpr int kSteps = 200;
constexpr double kPrecision = 1e-5;  ///< [m or rad]

/// The configuration whose front is nearest to `center`: the best of a grid, then a ternary search around it. Asks nothing of
/// the model but its prediction, so that it serves every type of joint.
double nearestConfiguration(const LearnedModel& model, const Eigen::Vector3d& center) {
  const auto distance = [&](double q) { return (model.predict(q).translation() - center).norm(); };
  const double span = std::max(model.q_max - model.q_min, 1e-6);
  const double from = model.q_min - kBeyond * span, step = (1 + 2 * kBeyond) * span / kSteps;
  double best = from;
  for (int i = 1; i <= kSteps; ++i)
    if (distance(from + i * step) < distance(best)) best = from + i * step;
  double low = best - step, high = best + step;
  while (high - low > kPrecision) {
    const double third = (high - low) / 3;
    if (distance(low + third) < distance(high - third))
      high -= third;
    else
      low += third;
  }
  return (low + high) / 2;
}

}  // namespace

PredictionError predictionError(const LearnedModel& model, const std::vector<ReferencePose>& truth) {
  PredictionError error;
  for (const ReferencePose& reference : truth) {
    const double q = model.type == JointType::kRigid ? 0 : nearestConfiguration(model, reference.rectangle.center());
    Rectangle predicted = reference.rectangle;
    predicted.pose = model.predict(q);
    const Rectangle described = alignDescription(reference.rectangle, predicted, true);
    error.position += (predicted.center() - reference.rectangle.center()).norm() / truth.size();
    error.orientation += angleBetween(predicted.pose, described.pose) / truth.size();
  }
  return error;
}

}  // namespace cabinet_articulation::core::evaluation
