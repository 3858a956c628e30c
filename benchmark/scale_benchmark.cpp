// SPDX-License-Identifier: BSD-3-Clause
// How the cost of a frame grows: with pixels, disparities, fronts in view, the length of tracks and the number of cameras. Each
// case runs in a process of its own, so that its memory is its own.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <opencv2/core/utility.hpp>
#include <string>
#include <thread>
#include <vector>

#include "allocation_counter.h"
#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "scores/interval_coverage.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr int kFrames = 8;       ///< of a run, looked at again and again
constexpr int kRounds = 4;       ///< the first warms up
constexpr int kUpdates = 20;     ///< of a track
constexpr double kPlace = 0.28;  ///< share of the kitchen's run at which its door is open

struct Images {
  StereoCamera camera;
  std::vector<StereoFrame> frames;
};

Images record(SimulatedStereoCamera& simulation, double place) {
  Images images{simulation.camera(), {}};
  const int first = static_cast<int>(place * (simulation.frameCount() - kFrames));
  for (int i = 0; i < kFrames; ++i) images.frames.push_back(simulation.frame(first + i));
  return images;
}

/// The same view in more pixels.
Images kitchen(int width, int height) {
  SimulationConfig config;
  config.scene = "kitchen";
  config.focal_length *= static_cast<double>(width) / config.width;
  config.width = width;
  config.height = height;
  SimulatedStereoCamera simulation(config);
  return record(simulation, kPlace);
}

/// A wall of closed fronts, each 10 cm before or behind its neighbours.
Images wallOfFronts(int columns, int rows) {
  constexpr double kWidth = 1.1, kHeight = 0.8, kGap = 0.02, kStep = 0.1, kDistance = 1.3;  // [m]
  Scene scene;
  addBox(boxBetween({-3, 0.4, -2}, {3, 0.5, 2}), 0.5, kFixedPart, &scene.surfaces);
  for (int column = 0; column < columns; ++column)
    for (int row = 0; row < rows; ++row) {
      const double x = (static_cast<double>(column) / columns - 0.5) * kWidth,
                   z = (static_cast<double>(row) / rows - 0.5) * kHeight;
      const double y = (column + row) % 2 * kStep;
      addBox(boxBetween({x, y, z}, {x + kWidth / columns - kGap, y + 0.018, z + kHeight / rows - kGap}), 0.6, kFixedPart,
             &scene.surfaces);
    }
  scene.view_point = {0.05, -kDistance, 0.05};
  scene.view_target = {0, 0, 0};
  SimulationConfig config;
  SimulatedStereoCamera simulation(config, scene, MotionScript({}, 2));
  return record(simulation, 0);
}

/// [ms] of processor time of this thread: other programs do not count.
double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

struct Cost {
  double milliseconds = 0;  ///< the median of a frame or an update
  double kilobytes = 0;     ///< taken from the heap for one, in the mean
  std::string found;
};

/// Every frame after the first round.
Cost run(const Images& images, const PipelineConfig& config) {
  Pipeline pipeline(config);
  std::vector<double> times;
  Allocations before;
  PipelineResult result;
  for (int i = 0; i < kRounds * kFrames; ++i) {
    if (i == kFrames) before = allocations();
    const StereoFrame& frame = images.frames[i % kFrames];
    const double start = now();
    result = pipeline.process(i / 15.0, frame.left, frame.right, images.camera);
    if (i >= kFrames) times.push_back(now() - start);
  }
  const auto bytes = static_cast<double>(allocations().bytes - before.bytes);
  return {median(times), bytes / 1024 / static_cast<double>(times.size()),
          std::to_string(result.planes.size()) + " regions, " + std::to_string(result.tracks->size()) + " tracks"};
}

Cost learn(int observations) {
  const Track whole = simulateNoisyFront(JointType::kRotational, 1, observations + kUpdates).track;
  std::vector<Track> tracks{whole};
  tracks[0].observations.resize(observations);
  ArticulationLearner learner({});
  learner.process(tracks);
  std::vector<double> times;
  const Allocations before = allocations();
  while (times.size() < kUpdates) {
    tracks[0].observations.push_back(whole.observations[tracks[0].observations.size()]);
    const double start = now();
    learner.process(tracks);
    times.push_back(now() - start);
  }
  return {median(times), static_cast<double>(allocations().bytes - before.bytes) / 1024 / kUpdates, "one update"};
}

/// Each camera's pipeline has a thread, as in a nodelet manager.
Cost runCameras(int cameras) {
  const Images images = kitchen(640, 480);
  std::vector<Cost> costs(cameras);
  std::vector<std::thread> threads;
  const Allocations before = allocations();
  for (Cost& cost : costs) threads.emplace_back([&] { cost = run(images, {}); });
  for (std::thread& thread : threads) thread.join();
  Cost worst =
      *std::max_element(costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.milliseconds < b.milliseconds; });
  worst.kilobytes = static_cast<double>(allocations().bytes - before.bytes) / 1024 / (kRounds * kFrames * cameras);
  return worst;
}

void report(const std::string& name, const std::function<Cost()>& measure) {
  std::fflush(stdout);
  if (const pid_t child = fork(); child != 0) {
    int status = 0;
    waitpid(child, &status, 0);
    if (status != 0) std::printf("%-44s failed\n", name.c_str());
    return;
  }
  cv::setNumThreads(1);
  const Cost cost = measure();
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%-44s %9.2f %11.0f %10.0f   %s\n", name.c_str(), cost.milliseconds, cost.kilobytes, usage.ru_maxrss / 1024.0,
              cost.found.c_str());
  std::fflush(stdout);
  _exit(0);
}

void reportAll() {
  std::printf("%-44s %9s %11s %10s\n", "", "[ms]", "[kB/frame]", "[MB, peak]");
  for (const cv::Size size : {cv::Size(640, 480), cv::Size(848, 480), cv::Size(1280, 720)})
    for (const int disparities : {128, 256})
      report(std::to_string(size.width) + "x" + std::to_string(size.height) + ", " + std::to_string(disparities) + " disparities",
             [=] {
               PipelineConfig config;
               config.stereo.disparity_range = disparities;
               return run(kitchen(size.width, size.height), config);
             });
  for (const cv::Size grid : {cv::Size(5, 1), cv::Size(5, 4), cv::Size(10, 6)})
    report(std::to_string(grid.area()) + " fronts in view", [=] {
      PipelineConfig config;
      config.rectangles.max_rectangles = 2 * grid.area();
      config.planes.max_regions = 4 * grid.area();
      return run(wallOfFronts(grid.width, grid.height), config);
    });
  for (const int observations : {100, 10000})
    report("learner, a track of " + std::to_string(observations) + " observations", [=] { return learn(observations); });
  for (const int cameras : {1, 2})
    report(std::to_string(cameras) + " camera(s), each in a thread", [=] { return runCameras(cameras); });
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main() {
  cabinet_articulation::core::evaluation::reportAll();
  return 0;
}
