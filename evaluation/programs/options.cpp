// SPDX-License-Identifier: BSD-3-Clause
#include "programs/options.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace cabinet_articulation::core::evaluation {
namespace fs = std::filesystem;

Options::Options(int argc, char** argv, std::map<std::string, std::string> defaults) {
  std::string usage = "usage: " + fs::path(argv[0]).filename().string();
  for (const auto& [name, value] : defaults) usage += " [--" + name + " " + (value.empty() ? "FOLDER" : value) + "]";
  usage += " OUT";
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("--", 0) != 0) {
      if (!folder_.empty()) throw std::invalid_argument("two output folders: " + folder_ + " and " + argument + "\n" + usage);
      folder_ = argument;
      continue;
    }
    const std::string name = argument.substr(2);
    if (defaults.count(name) == 0) throw std::invalid_argument("unknown option " + argument + "\n" + usage);
    if (++i == argc) throw std::invalid_argument("a value is missing after " + argument + "\n" + usage);
    values_[name].push_back(argv[i]);
  }
  for (const auto& [name, value] : defaults)
    if (values_[name].empty()) values_[name] = {value};
  if (folder_.empty()) throw std::invalid_argument(usage);
  fs::create_directories(folder_);
}

int Options::count(const std::string& name) const {
  const std::string& value = text(name);
  if (value.empty() || value.size() > 8 || value.find_first_not_of("0123456789") != std::string::npos)
    throw std::invalid_argument("--" + name + " must be a whole number, not '" + value + "'");
  return std::stoi(value);
}

std::vector<std::string> findSequences(const std::string& folder, bool boards) {
  std::vector<std::string> found;
  if (folder.empty()) return found;
  if (!fs::is_directory(folder)) throw std::runtime_error("no such folder: " + folder);
  std::vector<fs::path> candidates{fs::path(folder)};
  for (const auto& entry : fs::directory_iterator(folder)) candidates.push_back(entry.path());
  for (const fs::path& candidate : candidates) {
    const bool is_board = candidate.filename().string().rfind("board", 0) == 0;
    if (fs::exists(candidate / "truth.json") && is_board == boards) found.push_back(candidate.string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace cabinet_articulation::core::evaluation
