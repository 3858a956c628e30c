// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace cabinet_articulation {

/// The parameters of one nodelet as a Markdown table: name, unit, default, allowed values, meaning.
struct ParameterTable {
  std::string nodelet;
  std::string markdown;
};

/// Every nodelet, in the order of the pipeline.
const std::vector<ParameterTable>& parameterTables();

}  // namespace cabinet_articulation
