// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/stereo/depth_view.h"

namespace cabinet_articulation::core {

/// [m] What is so near to a plane lies in it, when neighbours are looked for: the depth of a Kinect has
/// steps of 12 mm at 2 m.
constexpr double kNeighbourBand = 0.015;

/// [m] Points that may belong to a plane before it is fitted: it may still be off by as much as neighbours may.
constexpr double kNear = 2 * kNeighbourBand;

/// Cells of a view at a front's place or beside one of its edges.
struct CellCount {
  int in_plane = 0, before = 0, behind = 0;
  int blind = 0;  ///< without depth; of FrontInView alone

  int seen() const { return in_plane + before + behind; }
  int all() const { return seen() + blind; }
};

/// Halves of edges, for a neighbour may be shorter than the front: `Edge` twice, towards smaller coordinates first.
using CellsBeside = std::array<CellCount, 8>;
constexpr std::size_t kSides = std::tuple_size<CellsBeside>::value;

/// What a view shows where a front would be, and within a hand's breadth of its edges.
struct FrontInView {
  CellCount inside;
  CellsBeside beside;
  std::vector<Eigen::Vector3d> front;                       ///< points near the plane, inside; in the front's frame
  std::array<std::vector<Eigen::Vector3d>, kSides> around;  ///< the same, beside each side
};

/// `band` [m]: points so far from the front's plane still are in it.
FrontInView look(const DepthView& view, const Rectangle& front, double band);

/// FrontInView::beside alone, of every `step`-th row and column: what a search asks again and again.
CellsBeside lookBeside(const DepthView& view, const Rectangle& front, double band, int step);

/// Whether the front's plane goes on beyond a side, as far as it was seen.
bool goesOn(const CellCount& beside);

/// Whether it goes on beyond two opposite edges, each as a whole, where cells without depth count against it.
bool isBetweenSurfaces(const CellsBeside& beside);

/// Which sides have neighbours beside them, or nothing. The image or a hand may have cut the front. What is beside such a side
/// is more of the front, and says nothing about where it is closed. Also how much of the front is there at all.
class OwnEdges {
 public:
  /// A view in which the front was detected at this place. It was not closed then, so what goes on there goes along. `beside`:
  /// within kNeighbourBand. `inside`: within kNear, as fill() is used with such counts.
  void add(const CellsBeside& beside, const CellCount& inside);

  /// False for a side beyond which the front goes on, and while it is not known.
  bool isEdge(std::size_t side) const { return 2 * along_[side] < seen_[side]; }

  /// Share of the front that is in its plane, 0 to 1; less than 1 of a frame around a hole. Nothing while it is not known.
  std::optional<double> fill() const {
    return in_plane_ > 0 ? std::optional<double>(1.0 * in_plane_ / (in_plane_ + behind_)) : std::nullopt;
  }

 private:
  std::array<int, kSides> along_{}, seen_{};  ///< views
  std::int64_t in_plane_ = 0, behind_ = 0;    ///< cells inside
};

/// Log-odds [nats] that the surface that a front closes lies in its plane, from how it goes on beyond the sides. `seen` has the
/// best view of each side: neighbours open, too, and arms pass.
double surfaceLogOdds(const CellsBeside& seen);

/// Keeps for each side the view in which most of it is in the plane.
void keepBest(const CellsBeside& seen, const OwnEdges& edges, CellsBeside* best);

}  // namespace cabinet_articulation::core
