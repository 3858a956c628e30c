// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/tracking/track.h"
#include "rviz_plugin/display_colors.h"
#include "rviz_plugin/drawing.h"

namespace cabinet_articulation {

struct JointStyle {
  ColorBy color_by = ColorBy::kType;
  float alpha = 0.4F;            ///< of the surface
  int ghosts = 6;                ///< fronts over the range, at most as many observations; 1: at q_max; 0: none
  bool at_observations = false;  ///< ghosts where a front of the world was seen, moved to where the model says
  bool axis = true;              ///< the axis and how uncertain it is
  bool label = true;
  bool one_of_each_type = false;  ///< the one that was seen last; of those of one frame, that of the most probable type
  bool resting = true;            ///< also fronts that did not move, or in a way that no joint explains
};

/// Everything in the frame of the fronts that hang on the world; tracks are those of the same frame, or none. What hangs on
/// another front is drawn where that one is now, and left out where that one is not among the models.
void drawJoints(const std::vector<core::LearnedModel>& models, const std::vector<core::Track>& tracks, const JointStyle& style,
                Drawing* drawing);

/// Cross sections of the region in which the axis lies with 95 %, at even steps along it, by the model's covariance. The axis
/// passes a point s along it with the error dp + s * dw x axis, where (dp, dw) have that covariance. What is across the axis is
/// Gaussian with two degrees of freedom. Nothing for what has no axis, and for a covariance that is not finite or not given.
std::vector<TubeRing> axisUncertainty(const core::LearnedModel& model);

/// Where a hand would hold the front, in the front's frame: amid the edge that is farthest from the axis (what turns), or amid
/// the front (all others).
Eigen::Vector3d graspPoint(const core::LearnedModel& model);

}  // namespace cabinet_articulation
