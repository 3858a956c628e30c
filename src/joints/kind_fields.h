// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <vector>

#include "cabinet_articulation/kinds/joint_shape.h"

/// Shapes of joints in a model file. All that read throw std::runtime_error or std::invalid_argument saying what is wrong.
namespace cabinet_articulation::core {

YAML::Node toYaml(const JointShape& shape);

/// Nothing of a file that is older than kinds.
std::vector<JointShape> shapesFromYaml(const YAML::Node& node);

/// All shapes of both, up to kMostShapes: `shapes`, then the first of the others that are not the same as one of them.
std::vector<JointShape> united(std::vector<JointShape> shapes, const std::vector<JointShape>& others);

}  // namespace cabinet_articulation::core
