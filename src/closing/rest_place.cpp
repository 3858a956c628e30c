// SPDX-License-Identifier: BSD-3-Clause
#include "closing/rest_place.h"

#include <cmath>

namespace cabinet_articulation::core {
namespace {

/// Ours: before anything is known, a front near its closed place is as likely there as on its way. One view in a hundred is
/// wrong: two for a hundred of either.
constexpr double kWrong = 0.02;

double square(double x) { return x * x; }

class Likelihood {
 public:
  Likelihood(const std::vector<Correction>& measured, const Correction& surface, double reach)
      : measured_(measured), surface_(surface), reach_(reach) {}

  /// One step of EM, and how certain the views make it.
  Correction improved(double c) const {
    double information = 0, sum = 0;
    for (const Correction& each : measured_) {
      const double weight = shareAtRest(each, c) / square(each.sigma);
      information += weight;
      sum += weight * each.q;
    }
    const double prior = 1 / square(surface_.sigma);
    return {(sum + prior * surface_.q) / (information + prior), 1 / std::sqrt(information)};
  }

  /// [nats]
  double logAt(double c) const {
    double log = -square((c - surface_.q) / surface_.sigma) / 2;
    for (const Correction& each : measured_) log += std::log(atRest(each, c) + elsewhere(each, c));
    return log;
  }

  int viewsAt(double c) const {
    int views = 0;
    for (const Correction& each : measured_) views += 2 * shareAtRest(each, c) > 1 ? 1 : 0;
    return views;
  }

 private:
  static double atRest(const Correction& each, double c) {
    return std::exp(-square((each.q - c) / each.sigma) / 2) / (std::sqrt(2 * M_PI) * each.sigma);
  }

  double elsewhere(const Correction& each, double c) const {
    const double farther_open = std::erfc((c - each.q) / (std::sqrt(2) * each.sigma)) / 2;
    return (farther_open + kWrong) / reach_;
  }

  double shareAtRest(const Correction& each, double c) const {
    const double at_rest = atRest(each, c);
    return at_rest / (at_rest + elsewhere(each, c));
  }

  const std::vector<Correction>& measured_;
  const Correction& surface_;
  double reach_;
};

}  // namespace

std::optional<RestPlace> innermostRest(const std::vector<Correction>& measured, const Correction& surface, double reach) {
  const Likelihood likelihood(measured, surface, reach);
  std::optional<Correction> best;
  double best_log = 0;
  for (const Correction& start : measured) {
    const double log = likelihood.logAt(start.q);
    if (best && log <= best_log) continue;
    best = start;
    best_log = log;
  }
  if (!best) return std::nullopt;
  // Until a step is small against the certainty. Ours: EM slows down near its end, but takes some ten steps.
  for (int step = 0; step < 100; ++step) {
    const Correction next = likelihood.improved(best->q);
    const bool converged = std::abs(next.q - best->q) < 1e-3 * next.sigma;
    best = next;
    if (converged) break;
  }
  return RestPlace{*best, likelihood.viewsAt(best->q)};
}

}  // namespace cabinet_articulation::core
