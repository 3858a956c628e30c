// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace cabinet_articulation::fuzz {

/// Changes valid inputs a little, so that they get past the first check. It knows nothing of formats but what numbers look like:
/// as doubles and lengths within serialized messages, or written out. The same seed makes the same changes.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  /// One to five changes; what is too short to be anything becomes one of the `seeds` first.
  void operator()(const std::vector<std::string>& seeds, std::string* input);

  /// 0 to count - 1; count > 0.
  std::size_t below(std::size_t count) { return random_() % count; }

 private:
  void changeOnce(std::string* input);
  void overwriteNumber(std::string* input);
  void overwriteWord(std::string* input);
  void rewriteText(std::string* input);
  void moveBlock(std::string* input);

  std::mt19937_64 random_;
};

}  // namespace cabinet_articulation::fuzz
