// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"

namespace cabinet_articulation::core {

/*
 * One front in a file of learned models, field by field; every list of numbers has a fixed meaning:
 * a pose is [x, y, z, qx, qy, qz, qw]; an observation is [stamp, pose, width, height, edge support of -x +x -y +y, and the
 * upper triangle of the covariance, row by row].
 */

YAML::Node toYaml(const KnownFront& front);

/// Throws std::runtime_error naming the field and what was expected.
KnownFront frontFromYaml(const YAML::Node& node);

}  // namespace cabinet_articulation::core
