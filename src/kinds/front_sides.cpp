// SPDX-License-Identifier: BSD-3-Clause
#include "kinds/front_sides.h"

#include <cmath>

namespace cabinet_articulation::core {
namespace {

std::array<double, 2> logSides(double width, double height) { return {std::log(width), std::log(height)}; }

}  // namespace

FrontSides::FrontSides(const std::vector<JointShape>& shapes, const KindsConfig& config)
    : prior_freedom_(2 + config.spread_joints), prior_scatter_(config.spread_joints * config.side_spread * config.side_spread) {
  for (Side& side : sides_) side.scatter = prior_scatter_;
  // Welford's sums.
  for (const JointShape& shape : shapes) {
    if (!shape.hasSize()) continue;
    ++count_;
    const std::array<double, 2> logs = logSides(shape.width, shape.height);
    for (std::size_t i = 0; i < 2; ++i) {
      const double away = logs[i] - sides_[i].mean;
      sides_[i].mean += away / count_;
      sides_[i].scatter += away * (logs[i] - sides_[i].mean);
    }
  }
}

double FrontSides::logEvidence() const {
  if (count_ == 0) return 0;
  double sum = logDensityOfAny();
  for (const Side& side : sides_)
    sum += -0.5 * ((count_ - 1) * std::log(M_PI) + std::log(count_)) + std::lgamma(freedom() / 2) -
           std::lgamma(prior_freedom_ / 2) + 0.5 * prior_freedom_ * std::log(prior_scatter_) -
           0.5 * freedom() * std::log(side.scatter);
  return sum;
}

double FrontSides::logDensity(double width, double height) const {
  if (count_ == 0) return logDensityOfAny();
  const std::array<double, 2> logs = logSides(width, height);
  double sum = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const double away = logs[i] - sides_[i].mean;
    const double square = sides_[i].scatter * (count_ + 1) / count_ / freedom();  // of Student's scale
    sum += std::lgamma((freedom() + 1) / 2) - std::lgamma(freedom() / 2) - 0.5 * std::log(M_PI * freedom() * square) -
           0.5 * (freedom() + 1) * std::log1p(away * away / square / freedom());
  }
  return sum;
}

double FrontSides::logDensityOfAny() {
  constexpr double kShortest = 0.05, kLongest = 2.4;
  return -2 * std::log(std::log(kLongest / kShortest));
}

}  // namespace cabinet_articulation::core
