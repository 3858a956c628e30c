// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tools/report/chart.h"
#include "tools/report/run_record.h"

namespace cabinet_articulation {

/// The words of the two views.
struct ViewWords {
  const char *top, *side;        ///< titles
  const char *right, *up, *out;  ///< of the directions
};

/// Directions in which a front is looked at; unit vectors in the frame of its model.
struct Viewpoint {
  Eigen::Vector3d right, up, out;
  ViewWords words;
};

/// How somebody sees a front who stands before it: `out` is its normal, `up` along that edge which points most upwards.
/// `upwards` is a direction in the frame of the model.
Viewpoint beforeTheFront(const core::LearnedModel& model, const Eigen::Vector3d& upwards);

/// For poses of markers, which say nothing of the front's edges: `up` is the axis of what turns, `out` is where it moved.
Viewpoint alongTheMotion(const FrontRecord& front, const Eigen::Vector3d& upwards);

/// Edges as somebody sees them who stands before the front.
enum Side { kUpper = 0, kLower = 1, kLeft = 2, kRight = 3 };

/// Those of the front's edges, which are in the order of `core::Edge`.
std::array<Side, 4> sidesOf(const core::LearnedModel& model, const Viewpoint& view);

const char* nameOf(Side side);

/// What the lower axis of charts over time shows.
struct TimeAxis {
  std::string label;
  Range range;
  double period = 0;  ///< between two frames
};

/// The opening that the model as it is known last gives to each observation; of what is no joint, how far its centre moved.
Chart openingChart(const FrontRecord& front, const TimeAxis& time);

/// Probability of each type, as it was told at the time.
Chart probabilityChart(const FrontRecord& front, const TimeAxis& time);

/// How much of each edge was seen.
Chart edgeChart(const FrontRecord& front, const Viewpoint& view, const TimeAxis& time);

/// From above (right, out) and from the side (out, up), relative to the front's centre at q = 0. Axis and way are drawn as they
/// were learned, fronts and centres as they were observed.
Chart topChart(const FrontRecord& front, const Viewpoint& view);
Chart sideChart(const FrontRecord& front, const Viewpoint& view);

/// [cm, deg] what one unit of the model's q is in charts, and its name.
double shownScale(const core::LearnedModel& model);
const char* shownUnit(const core::LearnedModel& model);

/// "0.0 to 26.9 cm"
std::string shownRange(const core::LearnedModel& model);

}  // namespace cabinet_articulation
