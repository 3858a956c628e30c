// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation::core {

/// One file of config/: its path there without ".yaml", what it must contain, and the same as fields for the documentation.
struct ConfigFile {
  std::string stage;
  std::string yaml;
  std::vector<detail::FieldText> fields;
};

/// Every configuration of the package, in the order of the pipeline: the defaults, then the paper's in paper/.
const std::vector<ConfigFile>& configCatalogue();

}  // namespace cabinet_articulation::core
