// SPDX-License-Identifier: BSD-3-Clause
// print_config STAGE: every setting of a stage with its default, unit, range and meaning, as YAML; print_config paper/STAGE:
// with its value in the paper's recipe.
// print_config --table NODELET: every parameter of a nodelet, as a Markdown table.
#include <iostream>
#include <string>

#include "tools/settings/config_catalogue.h"
#include "tools/settings/parameter_tables.h"

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  const std::vector<std::string> words(argv + 1, argv + argc);
  for (const core::ConfigFile& file : core::configCatalogue()) {
    if (words.size() != 1 || words[0] != file.stage) continue;
    std::cout << file.yaml;
    return 0;
  }
  for (const ParameterTable& table : parameterTables()) {
    if (words.size() != 2 || words[0] != "--table" || words[1] != table.nodelet) continue;
    std::cout << table.markdown;
    return 0;
  }
  std::cerr << "usage: print_config STAGE, where STAGE is one of";
  for (const core::ConfigFile& file : core::configCatalogue()) std::cerr << ' ' << file.stage;
  std::cerr << "\n       print_config --table NODELET, where NODELET is one of";
  for (const ParameterTable& table : parameterTables()) std::cerr << ' ' << table.nodelet;
  std::cerr << '\n';
  return 1;
}
