// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/request_limits.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {
namespace {

/// "x is 1e+155 m, expected -10000 to 10000 m", or nothing for what is within.
std::string outside(const std::string& name, double value, double lowest, double highest, const char* unit = "m") {
  if (value >= lowest && value <= highest) return "";
  std::ostringstream text;
  text << name << " is " << value << ' ' << unit << ", expected " << lowest << " to " << highest << ' ' << unit;
  return text.str();
}

}  // namespace

void requireFewEntries(std::size_t count, const std::string& what) {
  if (count > kMostEntries)
    throw ModelError("there are " + std::to_string(count) + " " + what + ", expected " + std::to_string(kMostEntries) +
                     " at most: more of them would hold up the stages that share the process");
}

void requireOpening(double q) {
  if (!std::isfinite(q)) throw ModelError("q is not finite");
  const std::string trouble = outside("q", q, -kLargestOpening, kLargestOpening, "m or rad");
  if (!trouble.empty()) throw ModelError(trouble);
}

std::string positionTrouble(const Eigen::Vector3d& position, double farthest) {
  const char* const names[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const std::string trouble = outside(names[i], position[i], -farthest, farthest);
    if (!trouble.empty()) return trouble;
  }
  return "";
}

std::string frontTrouble(const Rectangle& rectangle) {
  for (const auto& [name, side] : {std::make_pair("width", rectangle.width), std::make_pair("height", rectangle.height)}) {
    const std::string trouble = side == 0 ? "" : outside(name, side, kShortestSide, kLongestSide);
    if (!trouble.empty()) return trouble;
  }
  return positionTrouble(rectangle.pose.translation());
}

void requireSaneTrack(const Track& track) {
  requireFewEntries(track.observations.size(), "poses");
  const auto require = [](const std::string& where, const std::string& trouble) {
    if (!trouble.empty()) throw ModelError(where + ": " + trouble);
  };
  require("the track", frontTrouble({Eigen::Isometry3d::Identity(), track.width, track.height}));
  for (std::size_t i = 0; i < track.observations.size(); ++i) {
    require("pose " + std::to_string(i), frontTrouble(track.observations[i].rectangle));
    require("measured pose " + std::to_string(i), frontTrouble(track.observations[i].measured));
  }
}

}  // namespace cabinet_articulation::core
