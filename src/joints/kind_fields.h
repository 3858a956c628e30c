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

/// All shapes of both; what was saved and read is the same, but for the digits that a file has not.
std::vector<JointShape> united(std::vector<JointShape> shapes, const std::vector<JointShape>& others);

}  // namespace cabinet_articulation::core
