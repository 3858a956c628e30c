// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {

/// Fronts of one body, whose surfaces are one plane when they are closed.
struct PieceOfFurniture {
  std::vector<std::size_t> fronts;             ///< indices
  std::vector<Eigen::Isometry3d> closed = {};  ///< where each of them is closed, as far as that is known
};

/*
 * Ours. Two closed fronts with the normals n_a and n_b are compared at the point half-way between their centres, along the mean
 * normal n. Their distance there and their tilt, n_a x n_b within the plane, are e. S is its covariance: what both poses are
 * uncertain by (predictWithCovariance), and how far fronts of one piece are from flush. Fronts are in one plane if N(e; 0, S) is
 * more likely than each of these:
 * - parallel surfaces at any distance of up to the depth of a kitchen unit: for the distance alone, which the tilt does not tell;
 * - surfaces that face the camera from any side: a uniform density over the half sphere, and that of the distance.
 * So poses that are known badly join nothing that is far away.
 *
 * Where a front is closed is not always known: in one plane with others, it may be told from them only when it stands out.
 * It is taken for closed at q = 0, at q_min or beyond, whichever is the most likely. Beyond, what turns is closed where it is
 * parallel to the other front. A door that was first seen ajar belongs to the fronts whose plane its hinge is in. What slides is
 * closed anywhere on the next 0.05 m of its way, which tells less. A uniform density takes the place of that of the distance.
 */

/// Together are joints that are connected by pairs which lie in one plane when closed, with a gap of at most 0.6 m between them.
/// All are in the order of the models.
std::vector<PieceOfFurniture> piecesOfFurniture(const std::vector<LearnedModel>& joints);

}  // namespace cabinet_articulation::core
