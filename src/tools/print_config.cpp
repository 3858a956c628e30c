// SPDX-License-Identifier: BSD-3-Clause
// print_config [STAGE]: every setting of a stage with its default, unit, range and meaning, as YAML.
#include <iostream>

#include "config_catalogue.h"

int main(int argc, char** argv) {
  using namespace cabinet_articulation::core;
  const auto& catalogue = configCatalogue();
  if (argc == 2) {
    for (const ConfigFile& file : catalogue) {
      if (file.stage != argv[1]) continue;
      std::cout << file.yaml;
      return 0;
    }
  }
  std::cerr << "usage: print_config STAGE, where STAGE is one of";
  for (const ConfigFile& file : catalogue) std::cerr << ' ' << file.stage;
  std::cerr << '\n';
  return 1;
}
