// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/joints/model_file.h"

namespace cabinet_articulation::core {

/// The text of a file of learned models (YAML).
std::string toText(const ModelFile& models);

/// Throws std::runtime_error saying what is wrong.
ModelFile modelsFromText(const std::string& text);

/// Whether this was written as a model file once, however damaged it is.
bool wasModelFile(const std::string& text);

}  // namespace cabinet_articulation::core
