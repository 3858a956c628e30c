// SPDX-License-Identifier: BSD-3-Clause
// What every stage costs on one frame, one thread, beside OpenCV's StereoBM on the same pair. The frames are those of the
// simulated kitchen, or of the sequence in the folder that the variable CABINET_SEQUENCE names.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <map>
#include <memory>
#include <opencv2/calib3d.hpp>
#include <opencv2/core/utility.hpp>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "recorded_sequence.h"
#include "simulated_sources.h"

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
  prepared.rectangles = RectangleDetector({}).process(prepared.depth, prepared.regions);
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
  for (auto _ : state) matcher->compute(input.frame.left, input.frame.right, disparity);
}

void stereo(benchmark::State& state) {
  const Prepared& input = prepare(state);
  BlockMatcher matcher({});
  for (auto _ : state) benchmark::DoNotOptimize(matcher.process(input.frame.left, input.frame.right, input.camera));
}

void planes(benchmark::State& state) {
  const Prepared& input = prepare(state);
  PlaneSegmenter segmenter({});
  for (auto _ : state) benchmark::DoNotOptimize(segmenter.process(input.depth));
  state.counters["regions"] = static_cast<double>(input.regions.size());
}

void planesUnrefined(benchmark::State& state) {
  const Prepared& input = prepare(state);
  PlanesConfig config;
  config.refine = false;
  PlaneSegmenter segmenter(config);
  for (auto _ : state) benchmark::DoNotOptimize(segmenter.process(input.depth));
}

void rectangles(benchmark::State& state) {
  const Prepared& input = prepare(state);
  RectangleDetector detector({});
  for (auto _ : state) benchmark::DoNotOptimize(detector.process(input.depth, input.regions));
  state.counters["rectangles"] = static_cast<double>(input.rectangles.size());
}

/// The search alone, in the region of the best supported rectangle.
void oneRectangle(benchmark::State& state) {
  const Prepared& input = prepare(state);
  if (input.rectangles.empty()) return state.SkipWithError("no rectangle in this frame");
  const std::vector<PlaneRegion> region{input.regions[input.rectangles[0].region]};
  RectanglesConfig config;
  config.refine_edges = false;
  RectangleDetector detector(config);
  for (auto _ : state) benchmark::DoNotOptimize(detector.process(input.depth, region));
}

void tracking(benchmark::State& state) {
  const Prepared& input = prepare(state);
  RectangleTracker tracker({});
  double stamp = 0;
  for (auto _ : state) benchmark::DoNotOptimize(tracker.process(stamp += 1.0 / 15, input.rectangles));
}

/// All stages, with tracks that feed back; every frame is the same one.
void pipeline(benchmark::State& state) {
  const Prepared& input = prepare(state);
  Pipeline pipeline({});
  double stamp = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(pipeline.process(stamp += 1.0 / 15, input.frame.left, input.frame.right, input.camera));
}

// Two places of the run: in the kitchen the door is open in the first, the drawer in the second.
#define AT_TWO_PLACES(function) BENCHMARK(function)->Arg(28)->Arg(74)->Unit(benchmark::kMillisecond)
AT_TWO_PLACES(opencvStereoBm);
AT_TWO_PLACES(stereo);
AT_TWO_PLACES(planes);
AT_TWO_PLACES(planesUnrefined);
AT_TWO_PLACES(rectangles);
AT_TWO_PLACES(oneRectangle);
AT_TWO_PLACES(tracking);
AT_TWO_PLACES(pipeline);
#undef AT_TWO_PLACES

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
