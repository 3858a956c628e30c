// SPDX-License-Identifier: BSD-3-Clause
#include "joints/front_place.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {
namespace {

// Beside the tracker's tolerances: a map may lie elsewhere by some centimetres a day later (ours).
constexpr double kPlaceTolerance = 0.05;  // [m]
constexpr double kLargestShift = 0.4;     // of a side: an equal neighbour is at least one side away
constexpr double kAngleTolerance = 0.39;  // [rad]
constexpr double kSizeTolerance = 0.05;   // [m]
constexpr int kPlaces = 9;                // along what was seen of a way

bool isAlike(double a, double b) { return a <= 0 || b <= 0 || std::abs(a - b) <= kSizeTolerance; }

std::optional<double> distanceBetween(const Rectangle& a, const Rectangle& b) {
  const Rectangle aligned = alignDescription(a, b, false);
  if (angleBetween(aligned.pose, b.pose) > kAngleTolerance) return std::nullopt;
  if (!isAlike(aligned.width, b.width) || !isAlike(aligned.height, b.height)) return std::nullopt;
  double tolerance = kPlaceTolerance;
  for (const double side : {a.width, a.height, b.width, b.height})
    if (side > 0) tolerance = std::min(tolerance, kLargestShift * side);
  const double distance = (a.center() - b.center()).norm();
  return distance <= tolerance ? std::optional<double>(distance) : std::nullopt;
}

/// Where the way comes nearest to a place.
double nearestOnWay(const Rectangle& place, const LearnedModel& way) {
  return std::clamp(way.configuration(place.pose), way.q_min - beyondSeen(way), way.q_max + beyondSeen(way));
}

/// From where `seen` was to the way of the other.
std::optional<double> distanceToWay(const LearnedModel& seen, const LearnedModel& way) {
  std::optional<double> best;
  for (int i = 0; i < kPlaces; ++i) {
    const Rectangle place = frontAt(seen, seen.q_min + (seen.q_max - seen.q_min) * i / (kPlaces - 1));
    const std::optional<double> distance = distanceBetween(place, frontAt(way, nearestOnWay(place, way)));
    if (distance && (!best || *distance < *best)) best = distance;
  }
  return best;
}

}  // namespace

double beyondSeen(const LearnedModel& model) { return modelEntry(model.type).unit == ConfigurationUnit::kRadian ? 0.3 : 0.1; }

std::optional<double> samePlace(const LearnedModel& a, const LearnedModel& b) {
  if ((a.parent == 0) != (b.parent == 0)) return std::nullopt;
  const std::optional<double> forth = distanceToWay(a, b), back = distanceToWay(b, a);
  if (!forth || !back) return forth ? forth : back;
  return std::min(*forth, *back);
}

bool isSameFront(const ForgottenFront& forgotten, const LearnedModel& model, const std::vector<LearnedModel>& all) {
  if (forgotten.model.parent == 0 || model.parent == 0)
    return forgotten.model.parent == model.parent && samePlace(forgotten.model, model);
  const LearnedModel* parent = findModel(model.parent, all);
  if (!forgotten.parent || parent == nullptr || !hangsOnKnown(model, all)) return false;
  const LearnedModel way = placed(*parent, all);
  const double q = nearestOnWay(*forgotten.parent, way);
  return distanceBetween(*forgotten.parent, frontAt(way, q)) && samePlace(forgotten.model, transformed(model, way.predict(q)));
}

Eigen::Isometry3d turnBetween(const LearnedModel& target, const LearnedModel& source) {
  const Rectangle place = frontAt(target, (target.q_min + target.q_max) / 2), same = frontAt(source, nearestOnWay(place, source));
  return alignDescription(same, place, false).pose.inverse() * same.pose;
}

}  // namespace cabinet_articulation::core
