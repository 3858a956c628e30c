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
  int blind = 0;  ///< without depth; of FrontInView::inside alone

  int seen() const { return in_plane + before + behind; }
};

/// What a view shows where a front would be, and within a hand's breadth of its edges.
struct FrontInView {
  CellCount inside;
  std::array<CellCount, 4> beside;                     ///< in the order of `Edge`
  std::vector<Eigen::Vector3d> front;                  ///< points near the plane, inside; in the front's frame
  std::array<std::vector<Eigen::Vector3d>, 4> around;  ///< the same, beside each edge
};

/// `band` [m]: points so far from the front's plane still are in it.
FrontInView look(const DepthView& view, const Rectangle& front, double band);

/// FrontInView::beside alone, of every `step`-th row and column: what a search asks again and again.
std::array<CellCount, 4> lookBeside(const DepthView& view, const Rectangle& front, double band, int step);

/// Whether the front's plane goes on beyond an edge, as far as it was seen.
bool goesOn(const CellCount& beside);

/// Which edges have neighbours beside them, or nothing. The image or a hand may have cut the front. What is beside such an edge
/// is more of the front, and says nothing about where it is closed.
class OwnEdges {
 public:
  /// A view in which the front was detected at this place. It was not closed then, so what goes on there goes along.
  void add(const FrontInView& seen);

  /// False for an edge beyond which the front goes on, and while it is not known.
  bool isEdge(std::size_t edge) const { return 2 * along_[edge] < seen_[edge]; }

 private:
  std::array<int, 4> along_{}, seen_{};  ///< views
};

/// Log-odds [nats] that the surface that a front closes lies in its plane, from how it goes on beyond the edges. `seen` has the
/// best view of each edge: neighbours open, too, and arms pass.
double surfaceLogOdds(const std::array<CellCount, 4>& seen);

/// Keeps for each edge the view in which most of it is in the plane.
void keepBest(const std::array<CellCount, 4>& seen, const OwnEdges& edges, std::array<CellCount, 4>* best);

}  // namespace cabinet_articulation::core
