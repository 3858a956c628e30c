// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "cabinet_articulation/simulation/scene.h"

namespace cabinet_articulation::core {

/// `kind`: door, drawer, kitchen or static (see makeScene). `hinge_left` also decides which side it is seen from: that of
/// the hinge, where the open door does not turn its back.
Scene makeKitchen(const std::string& kind, bool hinge_left, cv::RNG* random);

Scene makePedestal(cv::RNG* random);

// Fronts that hang on one another, or only seem to (see makeScene).
Scene makeBifold(cv::RNG* random);
Scene makeTrolley(cv::RNG* random);
Scene makeCupboard(cv::RNG* random);

/// The point at `distance` from the target, `azimuth` to the right of straight in front and `elevation` above. [rad]
Eigen::Vector3d viewPoint(const Eigen::Vector3d& target, double distance, double azimuth, double elevation);

constexpr double radians(double degrees) { return degrees * 3.14159265358979323846 / 180; }

}  // namespace cabinet_articulation::core
