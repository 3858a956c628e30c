// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string>

#include "seeded_loop.h"

namespace {

constexpr char kUsage[] =
    "usage: TARGET_fuzz CORPUS_FOLDER [--runs N] [--seconds S] [--seed K] [--running FILE]\n"
    "Tries the corpus and seeded mutations of it. A finding ends the program; its input is in FILE, ./running by default.\n";

cabinet_articulation::fuzz::LoopOptions parseOptions(int argc, char** argv) {
  cabinet_articulation::fuzz::LoopOptions options;
  options.running = "running";
  options.runs = std::numeric_limits<long>::max();
  if (argc < 2) throw std::invalid_argument("expected a folder");
  options.corpus = argv[1];
  for (int i = 2; i < argc; i += 2) {
    const std::string word = argv[i];
    if (i + 1 == argc) throw std::invalid_argument(word + " needs a value");
    if (word == "--runs")
      options.runs = std::stol(argv[i + 1]);
    else if (word == "--seconds")
      options.seconds = std::stod(argv[i + 1]);
    else if (word == "--seed")
      options.seed = static_cast<unsigned>(std::stoul(argv[i + 1]));
    else if (word == "--running")
      options.running = argv[i + 1];
    else
      throw std::invalid_argument("unknown option " + word);
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto result = cabinet_articulation::fuzz::runSeededLoop(parseOptions(argc, argv));
    std::printf("Done %ld runs, %ld accepted\n", result.runs, result.accepted);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n%s", argv[0], error.what(), kUsage);
    return 2;
  }
}
