// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "fuzz_target.h"
#include "mutator.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

/// libFuzzer's own changes, which it learns from what they reach, and ours, which know numbers.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size, unsigned int seed) {
  using namespace cabinet_articulation::fuzz;
  static const std::vector<std::string> kSeeds = seeds().valid;
  Mutator mutator(seed);
  if (size > 0 && mutator.below(3) == 0) return LLVMFuzzerMutate(data, size, max_size);
  std::string input(reinterpret_cast<const char*>(data), size);
  mutator(kSeeds, &input);
  const std::size_t length = std::min(input.size(), max_size);
  std::memcpy(data, input.data(), length);
  return length;
}
