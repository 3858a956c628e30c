// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/EvaluateModel.h>
#include <cabinet_articulation/ProjectConfigurations.h>
#include <cabinet_articulation/ProjectPoses.h>

#include "cabinet_articulation/articulation/articulation_config.h"

namespace cabinet_articulation {

// Answers about models that are sent in. They depend on the request alone, and throw core::ModelError or std::invalid_argument,
// in words for whoever asked.

EvaluateModel::Response evaluateModel(const EvaluateModel::Request& request, const core::ArticulationConfig& config);
ProjectPoses::Response projectPoses(const ProjectPoses::Request& request);
ProjectConfigurations::Response projectConfigurations(const ProjectConfigurations::Request& request);

}  // namespace cabinet_articulation
