// SPDX-License-Identifier: BSD-3-Clause
// What learning costs, one thread: all models fitted to a track of 20, 100 and 1000 poses; the first update after that, and the
// mean of twenty; and the slowest update while a whole track comes in pose by pose. Pose logs given as arguments are learned
// that way, too.
#include <ctime>
#include <filesystem>
#include <numeric>
#include <random>
#include <string>

#include "articulation/models/model_registry.h"
#include "limit_reporter.h"
#include "measure.h"
#include "scores/interval_coverage.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr int kLengths[] = {20, 100, 1000};
constexpr int kUpdates = 20, kRepetitions = 5;
constexpr int kWholeTrack = 400;
constexpr double kUpdateLimit = 0.5;  ///< [ms]
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

/// [s] Of each update after the first `known` observations were learned at once: the shortest of several runs.
std::vector<double> updateTimes(const Track& whole, std::size_t known) {
  std::vector<double> shortest(whole.observations.size() - known, 1e9);
  for (int run = 0; run < kRepetitions; ++run) {
    std::vector<Track> tracks{whole};
    tracks[0].observations.resize(known);
    ArticulationLearner learner({});
    learner.process(tracks);
    for (double& time : shortest) {
      tracks[0].observations.push_back(whole.observations[tracks[0].observations.size()]);
      const std::clock_t start = std::clock();
      benchmark::DoNotOptimize(learner.process(tracks));
      time = std::min(time, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
  }
  return shortest;
}

void firstUpdate(benchmark::State& state, JointType type) {
  const int known = static_cast<int>(state.range(0));
  const Track track = simulateNoisyFront(type, 1, known + 1).track;
  for (auto _ : state) state.SetIterationTime(updateTimes(track, static_cast<std::size_t>(known)).front());
}

void worstUpdate(benchmark::State& state, const Track& track) {
  for (auto _ : state) {
    const std::vector<double> times = updateTimes(track, 0);
    const auto worst = std::max_element(times.begin(), times.end());
    state.SetIterationTime(*worst);
    state.counters["at"] = static_cast<double>(worst - times.begin() + 1);
    state.counters["mean_us"] = 1e6 * std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
  }
}

/// A front on which `move` puts noisy poses; its argument runs from 0 to 1.
Track simulatedTrack(Eigen::Vector3d (*move)(double)) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0, 0.003);
  Track track = simulateNoisyFront(JointType::kPrismatic, 1, kWholeTrack).track;
  const Eigen::Isometry3d start = track.observations.front().rectangle.pose;
  for (std::size_t i = 0; i < track.observations.size(); ++i) {
    const Eigen::Vector3d noise(normal(random), normal(random), normal(random));
    track.observations[i].rectangle.pose = Eigen::Translation3d(move(static_cast<double>(i) / kWholeTrack) + noise) * start;
  }
  return track;
}

Track readTrack(const std::string& file) {
  const std::unique_ptr<TrackSource> log = openPoseLog(file, file, "other");
  std::vector<int> all(log->reference().size());
  std::iota(all.begin(), all.end(), 0);
  Track track;
  log->observe(all, [&track](const SeenFront& seen) { track = seen.track; });
  return track;
}

std::vector<std::pair<std::string, Track>> wholeTracks(const std::vector<std::string>& files) {
  std::vector<std::pair<std::string, Track>> tracks{
      {"prismatic", simulateNoisyFront(JointType::kPrismatic, 1, kWholeTrack).track},
      {"rotational", simulateNoisyFront(JointType::kRotational, 1, kWholeTrack).track},
      {"at_rest", simulatedTrack([](double) { return Eigen::Vector3d(0, 0, 0); })},
      {"no_joint", simulatedTrack([](double u) { return Eigen::Vector3d(0.6 * u, 0.1 * std::sin(7 * u), 0); })}};
  for (const std::string& file : files) tracks.emplace_back(file, readTrack(file));
  return tracks;
}

std::string nameOf(const char* what, JointType type, int length) {
  return std::string(what) + "/" + modelName(type) + "/" + std::to_string(length);
}

void registerBenchmarks(const std::vector<std::string>& files) {
  for (const JointType type : kTypes)
    for (const int length : kLengths) {
      const auto add = [&](const char* what, void (*run)(benchmark::State&, JointType)) {
        const std::string name = std::string(what) + "/" + modelName(type);
        return benchmark::RegisterBenchmark(name.c_str(), run, type)->Arg(length)->Unit(benchmark::kMillisecond);
      };
      add("fit", fit)->Repetitions(kRepetitions);
      add("update", update)->Repetitions(kRepetitions)->Iterations(kUpdates);
      add("first_update", firstUpdate)->UseManualTime()->Iterations(1);
    }
  for (const auto& [name, track] : wholeTracks(files))
    benchmark::RegisterBenchmark(("worst_update/" + name).c_str(), worstUpdate, track)
        ->UseManualTime()
        ->Iterations(1)
        ->Unit(benchmark::kMillisecond);
}

void reportLimits(const LimitReporter& times) {
  for (const JointType type : kTypes) {
    const std::string fit_100 = nameOf("fit", type, 100), update_100 = nameOf("update", type, 100);
    times.compare(fit_100 + " (paper: 7 ms)", fit_100, 2);
    times.compare(nameOf("fit", type, 1000) + " beside twice that of 100", nameOf("fit", type, 1000), fit_100, 2);
    times.compare(update_100, update_100, kUpdateLimit);
    times.compare(nameOf("update", type, 1000) + " beside twice that of 100", nameOf("update", type, 1000), update_100, 2);
  }
  times.compareAll("first_update/", kUpdateLimit);
  times.compareAll("worst_update/", kUpdateLimit);
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  using namespace cabinet_articulation::core::evaluation;
  std::vector<std::string> files;
  const auto is_file = [](const char* argument) { return std::filesystem::is_regular_file(argument); };
  std::copy_if(argv + 1, argv + argc, std::back_inserter(files), is_file);
  argc = static_cast<int>(std::remove_if(argv + 1, argv + argc, is_file) - argv);
  registerBenchmarks(files);
  return runBenchmarks(argc, argv, reportLimits);
}
