// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "cabinet_articulation/planes/plane_region.h"
#include "rectangles/chart/image_edge.h"
#include "rectangles/edges/edge_profile.h"

namespace cabinet_articulation::core {

/// A door turns about a hinge inside its edge, so that this edge goes back behind the neighbouring front as the door opens
/// (ours). Near it both surfaces have almost the same disparity: block matching cannot tell them apart, and neither can a
/// look at the door's plane alone. But where the neighbour's plane is known, too, each strip belongs to the plane that
/// explains it better.

/// Disparity of the surface beyond an edge relative to the rectangle's plane.
struct Neighbour {
  double at_edge = 0;  ///< [px] at the edge's middle, positive if the neighbour is nearer there
  double slope = 0;    ///< [px/px] outward
  double angle = 0;    ///< [rad] between the two planes
  DisparityPlane plane;

  double at(double offset) const { return at_edge + slope * offset; }  ///< `offset` [px] outward from the edge
};

/// The region, other than `region` itself, that begins beyond an edge and comes nearer outward. Nothing if none lies along
/// most of it, or if the two planes do not meet near it.
std::optional<Neighbour> neighbourBeyond(const ImageEdge& edge, const PlaneRegion& region,
                                         const std::vector<PlaneRegion>& regions);

/// Where the strips change from the rectangle's plane to its neighbour's.
struct Crease {
  double offset = 0;  ///< [px] outward from where the edge was
  double nearer = 0;  ///< [px] by how much the neighbour is nearer there: what it hides lies behind it
};

/// From the profiles of one edge on either plane. Nothing if one plane alone explains the strips about as well, or if the
/// neighbour is farther away.
std::optional<Crease> findCrease(const EdgeProfile::Residuals& on_plane, const EdgeProfile::Residuals& on_neighbour,
                                 const Neighbour& neighbour);

}  // namespace cabinet_articulation::core
