// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <istream>
#include <ostream>
#include <stdexcept>
#include <string>

#include "cabinet_articulation/tracking/track.h"

namespace cabinet_articulation::core {

/// A log cannot be read. The message names the file, the line and what was expected there.
class PoseLogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A pose track in a text file, as the original release writes them: one pose a line, metres, blank lines and lines that
/// start with # are skipped. 3 columns x y z; 7 columns + qx qy qz qw; 9 columns + width height, where the pose is a corner
/// of the rectangle.
struct PoseLog {
  int columns = 0;
  std::string warning;  ///< about what was mended, without the log's name; empty: nothing
  Track track;          ///< the given positions (3, 7 columns) or the rectangle's centres; stamps count the poses
};

/// Throws PoseLogError; also for geometry that is farther away or larger than limits.h allows, and for what is no
/// ordinary file. Quaternions are normalised, with a warning below length 0.95, as means of some are;
/// those shorter than 0.5 or longer than 1.05 are refused.
PoseLog readPoseLog(std::istream& in, const std::string& name);
PoseLog readPoseLog(const std::string& path);

/// The track as a log of 9 columns that readPoseLog() and the original release read; stamps are lost.
void writePoseLog(const Track& track, std::ostream& out);

}  // namespace cabinet_articulation::core
