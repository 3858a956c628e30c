// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

namespace cabinet_articulation::core::evaluation {

/// `PROGRAM [--name VALUE]... OUT`: the options a program knows with their defaults, and the folder it writes to. What is given
/// twice may be asked for all its values; else the last counts.
class Options {
 public:
  /// Throws std::invalid_argument with the usage for an unknown option, a missing value or a missing folder. Creates the folder.
  Options(int argc, char** argv, std::map<std::string, std::string> defaults);

  const std::string& text(const std::string& name) const { return values_.at(name).back(); }
  const std::vector<std::string>& texts(const std::string& name) const { return values_.at(name); }
  /// Throws std::invalid_argument unless the value is a whole number >= 0.
  int count(const std::string& name) const;

  std::string out(const std::string& file) const { return folder_ + "/" + file; }

 private:
  std::map<std::string, std::vector<std::string>> values_;
  std::string folder_;
};

/// The folders in `folder` (and itself) that hold a truth.json, sorted; `boards` selects those named board*, or all others.
std::vector<std::string> findSequences(const std::string& folder, bool boards);

}  // namespace cabinet_articulation::core::evaluation
