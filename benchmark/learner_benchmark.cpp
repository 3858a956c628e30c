// SPDX-License-Identifier: BSD-3-Clause
// What learning costs, one thread: all models fitted to a track of 20, 100 and 1000 poses, and the update after one more.
#include <string>

#include "cabinet_articulation/articulation/model_registry.h"
#include "interval_coverage.h"
#include "limit_reporter.h"
#include "measure.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr int kLengths[] = {20, 100, 1000};
constexpr int kUpdates = 20, kRepetitions = 5;
constexpr JointType kTypes[] = {JointType::kPrismatic, JointType::kRotational};

void fit(benchmark::State& state, JointType type) {
  const std::vector<Track> tracks{simulateNoisyFront(type, 1, static_cast<int>(state.range(0))).track};
  measure(state, [&] { return ArticulationLearner({}).process(tracks); });
}

/// One more observation in each iteration, after a track of the given length was learned.
void update(benchmark::State& state, JointType type) {
  const int known = static_cast<int>(state.range(0));
  const Track whole = simulateNoisyFront(type, 1, known + kUpdates + 1).track;
  std::vector<Track> tracks{whole};
  tracks[0].observations.resize(known);
  ArticulationLearner learner({});
  learner.process(tracks);
  measure(state, [&] {
    tracks[0].observations.push_back(whole.observations[tracks[0].observations.size()]);
    return learner.process(tracks);
  });
}

std::string nameOf(const char* what, JointType type, int length) {
  return std::string(what) + "/" + modelName(type) + "/" + std::to_string(length);
}

void reportLimits(const LimitReporter& times) {
  for (const JointType type : kTypes) {
    const std::string fit_100 = nameOf("fit", type, 100), update_100 = nameOf("update", type, 100);
    times.compare(fit_100 + " (paper: 7 ms)", fit_100, 2);
    times.compare(nameOf("fit", type, 1000) + " beside twice that of 100", nameOf("fit", type, 1000), fit_100, 2);
    times.compare(update_100, update_100, 0.5);
    times.compare(nameOf("update", type, 1000) + " beside twice that of 100", nameOf("update", type, 1000), update_100, 2);
  }
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  using namespace cabinet_articulation::core::evaluation;
  for (const auto type : kTypes)
    for (const int length : kLengths) {
      const auto add = [&](const char* what, void (*run)(benchmark::State&, cabinet_articulation::core::JointType)) {
        const std::string name = std::string(what) + "/" + cabinet_articulation::core::modelName(type);
        return benchmark::RegisterBenchmark(name.c_str(), run, type)
            ->Arg(length)
            ->Repetitions(kRepetitions)
            ->Unit(benchmark::kMillisecond);
      };
      add("fit", fit);
      add("update", update)->Iterations(kUpdates);
    }
  return runBenchmarks(argc, argv, reportLimits);
}
