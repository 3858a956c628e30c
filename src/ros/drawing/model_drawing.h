// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/geometry/rectangle.h"
#include "geometry/palette.h"

namespace cabinet_articulation {

/*
 * What markers and overlay have in common: how a model looks. ROS-free; everything in the frame of the model.
 */

/// Red, green, blue in 0..1.
using Color = core::palette::Rgb;

constexpr Color kRectangleColor = core::palette::kYellow;  ///< what one frame shows
constexpr Color kAxisColor = core::palette::kVermilion;
constexpr Color kWayColor{1, 1, 1};  ///< in images, from q = 0 to now

/// Grey: not enough motion yet; orange: no model describes it; else that of the joint's type.
Color colorOf(const core::LearnedModel& model);

/// True where q is an angle.
bool countsRadians(const core::LearnedModel& model);

/// "3 fridge": a front is asked for by its number, and people look for its name.
std::string shortLabelOf(const core::LearnedModel& model);

/// "3 fridge rotational 98 %, 34 deg (0 to 87)"; without the name where it has none.
std::string labelOf(const core::LearnedModel& model);

/// A label as lines: name and type, then the opening, where it has one.
std::vector<std::string> labelLines(const std::string& label);

/// The hinge line along the front (rotational), or from one end of the front's centre's way to the other: from, to.
std::pair<Eigen::Vector3d, Eigen::Vector3d> axisOf(const core::LearnedModel& model);

/// The way of the front's centre between two openings.
std::vector<Eigen::Vector3d> wayOf(const core::LearnedModel& model, double from, double to);

/// Fronts over the range that was seen, in even steps, q_min and q_max included; nothing for what is no joint.
constexpr int kSweepSteps = 8;
std::vector<core::Rectangle> sweepOf(const core::LearnedModel& model, int steps = kSweepSteps);

}  // namespace cabinet_articulation
