// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

namespace cabinet_articulation::fuzz {

/// A driver for where there is no libFuzzer.
struct LoopOptions {
  std::filesystem::path corpus;   ///< folder of inputs that are tried first; may be missing
  std::filesystem::path running;  ///< the input that is being tried, and that stays here if it is a finding
  long runs = 2000;               ///< mutations to try
  double seconds = 0;             ///< [s] end earlier; 0: do not
  unsigned seed = 1;              ///< the same one tries the same inputs
};

struct LoopResult {
  long runs = 0;
  long accepted = 0;
  long seeds_refused = 0;  ///< of the valid ones; then mutations test nothing
};

/// Tries the seeds and the corpus as they are, and then mutations of them. Ends the program at the first finding.
LoopResult runSeededLoop(const LoopOptions& options);

}  // namespace cabinet_articulation::fuzz
