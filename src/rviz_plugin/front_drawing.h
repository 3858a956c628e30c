// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/tracking/track.h"
#include "rviz_plugin/display_colors.h"
#include "rviz_plugin/drawing.h"

namespace cabinet_articulation {

/// What is drawn at an observation. The way of the centre is drawn with each.
enum class ObservationStyle { kRectangle, kCross, kAxes, kLine };

struct TrackStyle {
  ObservationStyle observations = ObservationStyle::kRectangle;
  ColorBy color_by = ColorBy::kId;
  double density = 20;       ///< [1/m] poses drawn for each metre of the centre's way; 0: all of them
  bool latest_only = false;  ///< the newest observation of each track
  bool projected = false;    ///< moved to where the track's model says, where it is a joint of the world
  float alpha = 0.5F;        ///< of all but the newest observation
};

/// Each edge as eight dashes that together are as long as the share of it that was observed: an edge that was seen is a line, and
/// one that was not has gaps or is missing. A faint surface shows where the whole rectangle is taken to be. Rectangles have
/// neither id, type nor age: by these they have the colour that they have in overlay and markers.
void drawRectangles(const std::vector<core::DetectedRectangle>& rectangles, ColorBy color_by, Drawing* drawing);

/// `model` is what was learned from the track, or null. Without one, type and probability are grey.
void drawTrack(const core::Track& track, const core::LearnedModel* model, const TrackStyle& style, Drawing* drawing);

/// The indices of the observations that are drawn: the first and the newest, and between them one for each step of the way.
std::vector<std::size_t> sampledObservations(const core::Track& track, double density);

}  // namespace cabinet_articulation
