// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/expected_fronts.h"

#include <algorithm>

namespace cabinet_articulation::core {
namespace {
constexpr double kVelocityBase = 0.1;  ///< [s] ours: noise of millimetres gives centimetres a second
constexpr double kLongestBase = 0.5;   ///< [s] ours: an older observation says nothing about the velocity now
}  // namespace

Rectangle ExpectedFront::at(double when, double horizon) const {
  const double ahead = std::clamp(when - stamp, 0.0, horizon);
  Rectangle predicted = rectangle;
  predicted.pose.translation() += ahead * velocity;
  const double speed = angular_velocity.norm();
  if (speed > 0) predicted.pose.linear() = Eigen::AngleAxisd(ahead * speed, angular_velocity / speed) * rectangle.pose.linear();
  return predicted;
}

ExpectedFront newestMotion(const std::vector<TrackedObservation>& history) {
  const TrackedObservation& newest = history.back();
  ExpectedFront front;
  front.stamp = newest.stamp;
  front.rectangle = newest.rectangle;
  for (auto older = history.rbegin() + 1; older != history.rend(); ++older) {
    const double base = newest.stamp - older->stamp;
    if (base > kLongestBase) break;
    if (base < kVelocityBase) continue;
    const Eigen::AngleAxisd turn(newest.rectangle.pose.linear() * older->rectangle.pose.linear().transpose());
    front.velocity = (newest.rectangle.center() - older->rectangle.center()) / base;
    front.angular_velocity = turn.angle() / base * turn.axis();
    break;
  }
  return front;
}

std::vector<Rectangle> ExpectedFronts::at(double stamp) const {
  std::vector<Rectangle> places;
  places.reserve(fronts.size());
  for (const ExpectedFront& front : fronts) places.push_back(front.at(stamp, horizon));
  return places;
}

}  // namespace cabinet_articulation::core
