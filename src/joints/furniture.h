// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation::core {

/// Where a front is closed: at q_closed, or at q = 0 where that is not known.
double closedConfiguration(const LearnedModel& model);

/*
 * Ours. Two closed fronts with the normals n_a and n_b are compared at the point half-way between their centres, along the mean
 * normal n. Their distance there and their tilt, n_a x n_b within the plane, are e, and S is its covariance: what both poses
 * are uncertain by (predictWithCovariance), and how far fronts of one piece are from flush. Fronts are in one plane if N(e; 0, S)
 * is more likely than each of these:
 * - parallel surfaces at any distance of up to the depth of a kitchen unit: for the distance alone, which the tilt does not tell;
 * - surfaces that face the camera from any side: a uniform density over the half sphere, and that of the distance.
 * So poses that are known badly join nothing that is far away.
 */

/// Indices of joints. Those are together that are connected by pairs which lie in one plane when closed, with a gap of at most
/// 0.6 m between them; all in the order of the models.
std::vector<std::vector<std::size_t>> piecesOfFurniture(const std::vector<LearnedModel>& joints);

}  // namespace cabinet_articulation::core
