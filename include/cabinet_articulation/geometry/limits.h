// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

namespace cabinet_articulation::core {

/*
 * What may come from outside: messages, requests, files, bags. Whatever reads them refuses everything else. So no number
 * overflows behind it, and no sender holds up or ends the stages that share a process. All other code trusts this.
 *
 * Lengths are far beyond every cabinet and camera, and far within what the arithmetic can carry (ours).
 */

/// Both ends are allowed.
struct Limit {
  double min, max;
  const char* unit;
};

namespace limits {

/// ros::Time ends at 4294967295 s (2106); tf and others that add to a stamp throw shortly before.
constexpr std::uint32_t kLastSecond = 4290000000U;

constexpr Limit kSensed{-1e7, 1e7, "m"};      ///< coordinate of a rectangle or transform: maps may count from far away, as UTM's
constexpr Limit kFromOrigin{-1e8, 1e8, "m"};  ///< coordinate of all that follows from these
constexpr Limit kFromFront{-100, 100, "m"};   ///< coordinate of a grasp from the front's centre
constexpr Limit kSide{0.001, 10, "m"};        ///< of a front: what min_side and max_side of the rectangles stage may be
constexpr Limit kRadius{0, 1e7, "m"};         ///< of a hinge: paths that hardly bend have large ones
constexpr Limit kSensedVariance{-1e6, 1e6, "m^2 or rad^2"};    ///< of a rectangle: a sigma of 1 km knows nothing
constexpr Limit kVariance{-1e9, 1e9, "m^2 or rad^2"};          ///< of an observation, in another frame and with the track's size
constexpr Limit kJointVariance{-1e12, 1e12, "m^2 or rad^2"};   ///< a path need not tell where along an axis its point is
constexpr Limit kProbability{0, 1 + 1e-9, "(a probability)"};  ///< sums of rounded ones may exceed 1
constexpr Limit kShare{0, 1, "(a share)"};
constexpr Limit kQuality{0, 1e9, "(a share)"};          ///< a rectangle may hold more of a plane than its region does
constexpr Limit kConfiguration{-100, 100, "m or rad"};  ///< fronts go a few metres, or around a few times
constexpr Limit kError{0, 1e4, "m or rad"};             ///< mean length of residuals
constexpr Limit kSpeed{0, 100, "m/s"};                  ///< nothing in a kitchen moves at 10 m/s
constexpr Limit kTurnRate{0, 100, "rad/s"};             ///< half a turn within a tenth of a second is 31 rad/s
constexpr Limit kHorizon{0, 10, "s"};                   ///< that of prediction_horizon of the tracking stage

constexpr Limit kImageSide{1, 16384, "px"};            ///< sums over a row of 20,000 pixels still fit 32 bits
constexpr Limit kImageArea{1, 1 << 26, "px"};          ///< compressed or to be rectified: 512 MB of pixels or maps (ours)
constexpr Limit kFocalLength{1, 1e5, "px"};            ///< 1000 px wide images of a hundredth of a radian
constexpr Limit kPrincipalPoint{-1e5, 1e5, "px"};      ///< rectified images may be cut out far from it
constexpr Limit kCellFocalLength{1e-3, 1e5, "cells"};  ///< of a grid of pixels
constexpr Limit kViewDepth{0, 100, "m"};               ///< no camera measures farther
constexpr Limit kBaseline{0.001, 10, "m"};
constexpr Limit kPlaneOffset{-100, 100, "m"};
constexpr Limit kUnitLength{0.99, 1.01, "(a unit vector)"};
constexpr Limit kDisparityPlane{-1e9, 1e9, "px"};          ///< planes that nearly pass through the camera are steep in disparity
constexpr Limit kBend{-20, 20, "px"};                      ///< of a depth camera's disparity; a PrimeSense's is 0.75 px
constexpr Limit kHullMargin{0, 1, "image sizes outside"};  ///< regions end at the border, fits may end a little beyond

constexpr std::size_t kMostEntries = 10000;  ///< ours: openings, steps, ids or poses; an answer takes 10 MB
constexpr std::size_t kMostFronts = 4000;    ///< ours: in a message; 2000 rectangles take 0.5 s (measured)
constexpr std::size_t kMostParents = 8;      ///< ours: from a front to the world; a box in a drawer behind a door has two

}  // namespace limits

bool isWithin(double value, const Limit& limit);

// Each throws std::invalid_argument that names the element, its value and what was expected. Not a number is never within.

void requireWithin(const char* element, double value, const Limit& limit);

/// The side of a front, where 0 says that it is not known.
void requireSideOrUnknown(const char* element, double value);

/// Each coordinate.
void requireWithin(const char* element, const Eigen::Vector3d& position, const Limit& limit);

/// All 36 elements of a covariance.
void requireCovariance(const char* element, const double* covariance, const Limit& limit);

/// A list of this many entries.
void requireAtMost(const char* entries, std::size_t count, std::size_t most);

}  // namespace cabinet_articulation::core
