// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cabinet_articulation::core {

/// That kinds were forgotten on purpose, so that they do not come back from a file: each file is rid of its own once.
class ClearedKinds {
 public:
  void clear();

  /// Whether the kinds of this file are to be forgotten when it is saved next.
  bool in(const std::string& file) const;

  /// Kinds of the file are those of this run: it was saved or loaded.
  void replaced(const std::string& file);

 private:
  bool cleared_ = false;
  std::vector<std::filesystem::path> replaced_;  ///< since
};

}  // namespace cabinet_articulation::core
