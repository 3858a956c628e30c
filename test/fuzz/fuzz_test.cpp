// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include "seeded_loop.h"

namespace cabinet_articulation::fuzz {
namespace {

/// Linked with one target at a time.
TEST(Fuzz, CorpusAndMutationsAreTakenOrRefused) {
  LoopOptions options;
  options.corpus = FUZZ_CORPUS;
  options.running = FUZZ_TARGET "_input." + std::to_string(::getpid());
  options.runs = FUZZ_RUNS;
  RecordProperty("input_of_a_crash", std::filesystem::absolute(options.running).string());
  const LoopResult result = runSeededLoop(options);
  EXPECT_EQ(result.runs, options.runs);
  EXPECT_EQ(result.seeds_refused, 0) << "a seed that is refused tests nothing";
  EXPECT_GT(result.accepted, options.runs / 50) << "hardly a mutation gets past the boundary";
}

}  // namespace
}  // namespace cabinet_articulation::fuzz
