// SPDX-License-Identifier: BSD-3-Clause
#include "seeded_loop.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuzz_target.h"
#include "mutator.h"

namespace cabinet_articulation::fuzz {
namespace {

constexpr unsigned kHang = 60;  // [s] of wall time; processor time is measured afterwards

std::vector<std::string> readCorpus(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> paths;
  if (std::filesystem::is_directory(folder))
    for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> inputs;
  for (const std::filesystem::path& path : paths) {
    std::ifstream file(path, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

/// Written before it is tried: nothing can be relied on after a crash.
void tryInput(const std::string& input, const std::filesystem::path& running) {
  if (!(std::ofstream(running, std::ios::binary) << input)) throw std::runtime_error(running.string() + " cannot be written");
  ::alarm(kHang);
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  ::alarm(0);
}

}  // namespace

LoopResult runSeededLoop(const LoopOptions& options) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto is_over = [&] {
    return options.seconds > 0 && std::chrono::duration<double>(Clock::now() - start).count() > options.seconds;
  };
  LoopResult result;
  const Seeds built = seeds();
  for (const std::string& input : built.valid) {
    tryInput(input, options.running);
    result.seeds_refused += !wasAccepted();
  }
  for (const std::string& input : built.hostile) tryInput(input, options.running);
  std::vector<std::string> pool = readCorpus(options.corpus);
  for (const std::string& input : pool) tryInput(input, options.running);
  pool.insert(pool.end(), built.valid.begin(), built.valid.end());
  Mutator mutator(options.seed);
  for (; result.runs < options.runs && !is_over(); ++result.runs) {
    std::string input = pool[mutator.below(pool.size())];
    mutator(built.valid, &input);
    tryInput(input, options.running);
    result.accepted += wasAccepted();
  }
  std::filesystem::remove(options.running);
  return result;
}

}  // namespace cabinet_articulation::fuzz
