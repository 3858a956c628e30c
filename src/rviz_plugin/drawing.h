// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "cabinet_articulation/geometry/rectangle.h"
#include "ros/drawing/model_drawing.h"

namespace cabinet_articulation {

/*
 * What a display shows, without RViz: lines, surfaces and texts in the frame of the message. What is drawn where can thus be
 * tested without a window.
 */

struct Paint {
  Color color{{1, 1, 1}};
  float alpha = 1;  ///< 0: not to be seen, 1: opaque
};

struct DrawnLine {
  Eigen::Vector3d from, to;
  Paint paint;
};

struct DrawnTriangle {
  std::array<Eigen::Vector3d, 3> corners;
  Paint paint;
};

struct DrawnText {
  Eigen::Vector3d at;
  std::string text;
  Paint paint;
};

struct Drawing {
  std::vector<DrawnLine> lines;
  std::vector<DrawnTriangle> triangles;
  std::vector<DrawnText> texts;
};

/// Where a tube's cross section lies: an ellipse with these conjugate half axes.
struct TubeRing {
  Eigen::Vector3d center, half_axis_a, half_axis_b;
};

void addPath(const std::vector<Eigen::Vector3d>& points, const Paint& paint, Drawing* drawing);
void addOutline(const core::Rectangle& rectangle, const Paint& paint, Drawing* drawing);
/// Its x and y axes, from edge to edge.
void addCross(const core::Rectangle& rectangle, const Paint& paint, Drawing* drawing);

/// Its frame, in the colours of tf: x red, y green, z blue. Each axis has the length of half the shorter side.
void addFrame(const core::Rectangle& rectangle, float alpha, Drawing* drawing);

void addSurface(const core::Rectangle& rectangle, const Paint& paint, Drawing* drawing);

/// The surface through the rings, in their order; open at both ends.
void addTube(const std::vector<TubeRing>& rings, const Paint& paint, Drawing* drawing);

}  // namespace cabinet_articulation
