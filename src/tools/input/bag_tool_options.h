// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/input/frame_bag.h"

namespace cabinet_articulation {

/// Of tools that read the frames of one bag and write another one.
struct BagToolOptions {
  std::string input, output, config;
  FrameBagOptions bag;
};

/// One option of a command line; its value is null if it takes none.
struct Choice {
  const char* name;
  int argument;  ///< getopt's
  std::function<void(const char*)> set;
};

/// The lines of a usage that explain the options for the input.
extern const char kBagInputUsage[];

/// Reads two bags, --config, the options for the input and the tool's own. False if only help was asked for. Throws
/// std::invalid_argument that names the option.
bool parseBagToolOptions(int argc, char** argv, const std::vector<Choice>& own, BagToolOptions* options);

}  // namespace cabinet_articulation
