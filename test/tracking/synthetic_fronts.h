// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/tracking/track.h"
#include "tracking/motion/motion_gate.h"
#include "tracking/size/placement.h"

namespace cabinet_articulation::core {

/// A front seen straight on from 1.5 m: x right, y down, its normal towards the camera.
inline Rectangle closedFront(double x = 0, double width = 0.395, double height = 0.58) {
  Rectangle front;
  front.pose.translation() = Eigen::Vector3d(x, 0.1, 1.5);
  front.pose.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  front.width = width;
  front.height = height;
  return front;
}

/// The same front pulled out by `q` [m].
inline Rectangle pulled(Rectangle front, double q) {
  front.pose.translation() += q * front.normal();
  return front;
}

/// The same front swung open by `q` [rad] about its edge at -x.
inline Rectangle swung(Rectangle front, double q) {
  const Eigen::Vector3d hinge(-front.width / 2, 0, 0);
  front.pose =
      front.pose * Eigen::Translation3d(hinge) * Eigen::AngleAxisd(-q, Eigen::Vector3d::UnitY()) * Eigen::Translation3d(-hinge);
  return front;
}

constexpr double kThickness = 0.018;  ///< [m] of the fronts, whatever the tracker takes it for

/// A detector with the noise of a good one: 2 mm, 0.3 degrees, 4 mm of size, and any description.
class NoisyDetector {
 public:
  explicit NoisyDetector(unsigned seed) : random_(seed) {}

  /// In any of the eight descriptions. The back is a board's thickness behind the front.
  DetectedRectangle operator()(const Rectangle& truth) {
    const auto k = static_cast<int>(random_() % kDescriptions);
    return describe(plain(k < kDescriptions / 2 ? truth : pulled(truth, -kThickness)), k);
  }

  /// In one of the four whose normal is that of `truth`, as a front is first seen.
  DetectedRectangle fromFront(const Rectangle& truth) {
    return describe(plain(truth), static_cast<int>(random_() % (kDescriptions / 2)));
  }

  /// In that of `truth`.
  DetectedRectangle plain(const Rectangle& truth) {
    DetectedRectangle detection;
    detection.rectangle = truth;
    detection.rectangle.pose.translate(Eigen::Vector3d(noise(0.002), noise(0.002), noise(0.002)));
    detection.rectangle.pose.rotate(Eigen::AngleAxisd(noise(0.005), Eigen::Vector3d(noise(1), noise(1), noise(1)).normalized()));
    detection.rectangle.width += noise(0.004);
    detection.rectangle.height += noise(0.004);
    detection.covariance = Matrix6d::Identity() * 4e-6;
    detection.edge_support = {1, 1, 1, 1};
    return detection;
  }

  double noise(double sigma) { return std::normal_distribution<double>(0, sigma)(random_); }

 private:
  std::mt19937 random_;
};

/// What remains visible when the edge is hidden, `amount` [m] of the front with it. The edge counts as unobserved.
inline DetectedRectangle withHiddenEdge(DetectedRectangle detection, Edge edge, double amount) {
  const int axis = edge / 2;
  const double direction = edge % 2 == 0 ? 0.5 : -0.5;
  detection.rectangle.pose.translate(direction * amount * Eigen::Vector3d::Unit(axis));
  (axis == 0 ? detection.rectangle.width : detection.rectangle.height) -= amount;
  detection.edge_support[edge] = 0;
  return detection;
}

constexpr double kFrame = 1.0 / 15;  ///< [s]

/// One observation for each place, kFrame apart from 0 on.
inline std::vector<TrackedObservation> historyOf(const std::vector<Rectangle>& places) {
  std::vector<TrackedObservation> history(places.size());
  for (size_t i = 0; i < places.size(); ++i) {
    history[i].stamp = i * kFrame;
    history[i].rectangle = places[i];
  }
  return history;
}

/// A smooth opening and closing within `period` [s]: 0 at the ends, 1 in the middle.
inline double opening(double t, double period) { return 0.5 - 0.5 * std::cos(2 * M_PI * t / period); }

/// Largest distance of the corners of a track's rectangles from the truth, in one description for the whole track.
inline double largestError(const Track& track, const std::function<Rectangle(double)>& truth) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < kDescriptions; ++k) {
    double worst = 0;
    for (const TrackedObservation& observation : track.observations)
      worst = std::max(worst, cornerDistance(observation.rectangle, describe(truth(observation.stamp), k)));
    best = std::min(best, worst);
  }
  return best;
}

}  // namespace cabinet_articulation::core
