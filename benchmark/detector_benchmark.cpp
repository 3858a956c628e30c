// SPDX-License-Identifier: BSD-3-Clause
// What every stage costs on one frame, one thread, beside OpenCV's StereoBM on the same pair. The frames are those of the
// simulated kitchen, or of the sequence in the folder that the variable CABINET_SEQUENCE names.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "limit_reporter.h"
#include "measure.h"
#include "sources/recorded_sequence.h"
#include "sources/simulated_sources.h"

namespace cabinet_articulation::core::evaluation {
namespace {

/// A frame and what the stages before the one that is measured make of it.
struct Prepared {
  StereoCamera camera;
  Frame frame;
  DepthFrame depth;
  std::vector<PlaneRegion> regions;
  std::vector<DetectedRectangle> rectangles;
};

std::unique_ptr<FrameSource> openSource() {
  const char* folder = std::getenv("CABINET_SEQUENCE");
  if (folder) return openRecordedSequence(folder);
  SimulationConfig config;
  config.scene = "kitchen";
  return simulateRun(config);
}

/// The frame at `percent` of the run.
const Prepared& prepare(int percent) {
  static const std::unique_ptr<FrameSource> source = openSource();
  static std::map<int, Prepared> cache;
  const auto known = cache.find(percent);
  if (known != cache.end()) return known->second;
  Prepared& prepared = cache[percent];
  prepared.camera = source->camera();
  prepared.frame = source->frame(percent * (source->size() - 1) / 100);
  prepared.depth = BlockMatcher({}).process(prepared.frame.left, prepared.frame.right, prepared.camera);
  prepared.regions = PlaneSegmenter({}).process(prepared.depth);
  prepared.rectangles = RectangleDetector({}, {}).process(prepared.depth, prepared.regions);
  return prepared;
}

const Prepared& prepare(const benchmark::State& state) { return prepare(static_cast<int>(state.range(0))); }

void opencvStereoBm(benchmark::State& state) {
  const Prepared& input = prepare(state);
  const StereoConfig config;
  const auto matcher = cv::StereoBM::create(config.disparity_range, config.correlation_window_size);
  matcher->setUniquenessRatio(static_cast<int>(config.uniqueness_ratio));
  matcher->setTextureThreshold(config.texture_threshold);
  matcher->setPreFilterCap(config.prefilter_cap);
  matcher->setPreFilterType(cv::StereoBM::PREFILTER_XSOBEL);
  matcher->setSpeckleWindowSize(config.speckle_size);
  matcher->setSpeckleRange(config.speckle_range);
  cv::Mat disparity;
  measure(state, [&] {
    matcher->compute(input.frame.left, input.frame.right, disparity);
    return disparity.data;
  });
}

void stereo(benchmark::State& state) {
  const Prepared& input = prepare(state);
  BlockMatcher matcher({});
  measure(state, [&] { return matcher.process(input.frame.left, input.frame.right, input.camera); });
}

void planes(benchmark::State& state) {
  const Prepared& input = prepare(state);
  PlaneSegmenter segmenter({});
  measure(state, [&] { return segmenter.process(input.depth); });
  state.counters["regions"] = static_cast<double>(input.regions.size());
}

void planesUnrefined(benchmark::State& state) {
  const Prepared& input = prepare(state);
  PlanesConfig config;
  config.refine = false;
  PlaneSegmenter segmenter(config);
  measure(state, [&] { return segmenter.process(input.depth); });
}

void rectangles(benchmark::State& state) {
  const Prepared& input = prepare(state);
  RectangleDetector detector({}, {});
  measure(state, [&] { return detector.process(input.depth, input.regions); });
  state.counters["rectangles"] = static_cast<double>(input.rectangles.size());
}

/// Planes and rectangles, with a track for every rectangle.
void detector(benchmark::State& state) {
  const Prepared& input = prepare(state);
  PlaneSegmenter segmenter({});
  RectangleDetector detector({}, {});
  std::vector<Rectangle> tracks;
  for (const DetectedRectangle& detection : input.rectangles) tracks.push_back(detection.rectangle);
  measure(state, [&] { return detector.process(input.depth, segmenter.process(input.depth), tracks); });
}

/// In the region of the best supported rectangle; `refined`: with its edges in the images, otherwise the search alone.
void oneRectangle(benchmark::State& state, bool refined) {
  const Prepared& input = prepare(state);
  if (input.rectangles.empty()) return state.SkipWithError("no rectangle in this frame");
  const std::vector<PlaneRegion> region{input.regions[input.rectangles[0].region]};
  RectanglesConfig config;
  config.refine_edges = refined;
  RectangleDetector detector(config, {});
  measure(state, [&] { return detector.process(input.depth, region); });
}

void tracking(benchmark::State& state) {
  const Prepared& input = prepare(state);
  RectangleTracker tracker({});
  double stamp = 0;
  measure(state, [&]() -> const std::vector<Track>& { return tracker.process(stamp += 1.0 / 15, input.rectangles); });
}

/// All stages, with tracks that feed back; every frame is the same one.
void pipeline(benchmark::State& state) {
  const Prepared& input = prepare(state);
  Pipeline pipeline({});
  double stamp = 0;
  measure(state, [&] { return pipeline.process(stamp += 1.0 / 15, input.frame.left, input.frame.right, input.camera); });
}

struct Stage {
  const char* name;
  std::function<void(benchmark::State&)> run;
};

const std::vector<Stage> kStages{{"opencvStereoBm", opencvStereoBm},
                                 {"stereo", stereo},
                                 {"planes", planes},
                                 {"planesUnrefined", planesUnrefined},
                                 {"rectangles", rectangles},
                                 {"detector", detector},
                                 {"rectangleSearch", [](benchmark::State& state) { oneRectangle(state, false); }},
                                 {"rectangleRefined", [](benchmark::State& state) { oneRectangle(state, true); }},
                                 {"tracking", tracking},
                                 {"pipeline", pipeline}};

// Two places of the run [%]: in the kitchen the door is open in the first, the drawer in the second.
constexpr int kPlaces[] = {28, 74};
constexpr int kRepetitions = 3;

void reportLimits(const LimitReporter& times) {
  for (const int place : kPlaces) {
    const auto at = [place](const char* stage) { return std::string(stage) + "/" + std::to_string(place); };
    times.compare(at("stereo") + " beside half of OpenCV's StereoBM", at("stereo"), at("opencvStereoBm"), 0.5);
    times.compare(at("detector") + " beside OpenCV's StereoBM", at("detector"), at("opencvStereoBm"));
    times.compare(at("planes") + " before refinement (paper: 845 ms)", at("planesUnrefined"), 10);
    times.compare(at("rectangle") + " optimised (paper: 313 ms)", at("rectangleSearch"), 1);
  }
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  using namespace cabinet_articulation::core::evaluation;
  cv::setNumThreads(1);
  for (const Stage& stage : kStages)
    for (const int place : kPlaces)
      benchmark::RegisterBenchmark(stage.name, stage.run)->Arg(place)->Repetitions(kRepetitions)->Unit(benchmark::kMillisecond);
  return runBenchmarks(argc, argv, reportLimits);
}
