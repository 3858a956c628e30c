// SPDX-License-Identifier: BSD-3-Clause
#include "joints/cleared_kinds.h"

#include <algorithm>

namespace cabinet_articulation::core {

namespace fs = std::filesystem;

void ClearedKinds::clear() {
  cleared_ = true;
  replaced_.clear();
}

bool ClearedKinds::in(const std::string& file) const {
  const auto is_same = [&file](const fs::path& other) {
    std::error_code not_there;
    return other == file || fs::equivalent(other, file, not_there);
  };
  return cleared_ && std::none_of(replaced_.begin(), replaced_.end(), is_same);
}

void ClearedKinds::replaced(const std::string& file) {
  if (in(file)) replaced_.emplace_back(file);
}

}  // namespace cabinet_articulation::core
