// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/stereo/depth_view.h"

namespace cabinet_articulation::core {

/// Cells of a view at a front's place or beside one of its edges.
struct CellCount {
  int in_plane = 0, before = 0, behind = 0;

  int seen() const { return in_plane + before + behind; }
};

/// What a view shows where a front would be, and within a hand's breadth of its edges.
struct FrontInView {
  CellCount inside;
  std::array<CellCount, 4> beside;      ///< in the order of `Edge`
  std::vector<Eigen::Vector3d> front;   ///< points near the plane, inside; in the front's frame
  std::vector<Eigen::Vector3d> around;  ///< the same, beside
};

/// `band` [m]: points so far from the front's plane still are in it.
FrontInView look(const DepthView& view, const Rectangle& front, double band);

/// Log-odds [nats] that the surface that a front closes lies in its plane, from how it goes on beyond the edges. `seen` has the
/// best view of each edge: neighbours open, too, and arms pass.
double surfaceLogOdds(const std::array<CellCount, 4>& seen);

/// Keeps for each edge the view in which most of it is in the plane.
void keepBest(const std::array<CellCount, 4>& seen, std::array<CellCount, 4>* best);

}  // namespace cabinet_articulation::core
