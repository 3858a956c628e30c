// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/*
 * What one request may ask for, and where a front may be in a log or a request (ours). A request beyond is refused as a whole.
 * Longer lists take the memory and the time of the stages that share the process. Geometry beyond loses its digits first, then
 * overflows within the fits.
 */

constexpr std::size_t kMostEntries = 10000;    ///< openings, steps, ids, poses; 0.5 s for fit_track, 10 MB for an answer
constexpr double kLargestOpening = 100;        ///< [m or rad] on either side of 0
constexpr double kFarthestGrasp = 100;         ///< [m] from the front's centre, in each coordinate
constexpr double kFarthestPosition = 10000;    ///< [m] from the origin of its frame, in each coordinate: the map of a large site
constexpr double kShortestSide = 0.001;        ///< [m] of a front; 0 is a size nobody knows
constexpr double kLongestSide = 100;           ///< [m] of a front

/// Throws ModelError for a list that is too long. `what` names its entries: "poses".
void requireFewEntries(std::size_t count, const std::string& what);

/// Throws ModelError for an opening that is not finite or too large.
void requireOpening(double q);

/// What is wrong with a position, or empty: "x is 1e+155 m, expected -10000 to 10000 m".
std::string positionTrouble(const Eigen::Vector3d& position, double farthest = kFarthestPosition);

/// The same for a front's place and size.
std::string frontTrouble(const Rectangle& rectangle);

/// Throws ModelError for a track that is too long, too far away or too large; it names the pose.
void requireSaneTrack(const Track& track);

}  // namespace cabinet_articulation::core
