// SPDX-License-Identifier: BSD-3-Clause
// What learning costs: all models fitted to a track of 20, 100 and 1000 poses, and the update after one more.
#include <benchmark/benchmark.h>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "interval_coverage.h"

namespace cabinet_articulation::core::evaluation {
namespace {

Track makeTrack(JointType type, int poses) { return simulateNoisyFront(type, 1, poses).track; }

void fit(benchmark::State& state, JointType type) {
  const Track track = makeTrack(type, static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(ArticulationLearner({}).process({track}));
}

/// One more observation in each iteration, after a track of the given length was learned.
void update(benchmark::State& state, JointType type) {
  const int known = static_cast<int>(state.range(0));
  const Track whole = makeTrack(type, known + static_cast<int>(state.max_iterations));
  std::vector<Track> track{whole};
  track[0].observations.resize(known);
  ArticulationLearner learner({});
  learner.process(track);
  for (auto _ : state) {
    track[0].observations.push_back(whole.observations[track[0].observations.size()]);
    benchmark::DoNotOptimize(learner.process(track));
  }
}

constexpr int kUpdates = 20;

BENCHMARK_CAPTURE(fit, drawer, JointType::kPrismatic)->Arg(20)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(fit, door, JointType::kRotational)->Arg(20)->Arg(100)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(update, drawer, JointType::kPrismatic)
    ->Arg(20)
    ->Arg(100)
    ->Arg(1000)
    ->Iterations(kUpdates)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(update, door, JointType::kRotational)
    ->Arg(20)
    ->Arg(100)
    ->Arg(1000)
    ->Iterations(kUpdates)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

BENCHMARK_MAIN();
