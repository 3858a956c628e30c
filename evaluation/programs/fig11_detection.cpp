// SPDX-License-Identifier: BSD-3-Clause
// Paper, Fig. 11: how often a front is found, how many planes must be searched for it, and how far its pose errs, against its
// distance. Beyond the paper: what is learned from the same frames where they follow one another, a moving camera, and a depth
// image in place of the stereo pair.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgcodecs.hpp>

#include "articulation/models/model_registry.h"
#include "geometry/degrees.h"
#include "programs/options.h"
#include "programs/parallel.h"
#include "scores/learned_run.h"
#include "scores/learning_curve.h"
#include "sources/recorded_sequence.h"
#include "sources/simulated_sources.h"
#include "sources/variants.h"
#include "tables/csv_writer.h"
#include "tables/detection_table.h"
#include "tables/failure_picture.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr double kCameraMotion = 0.1;  // [m]

/// Frames [first, last) of one source, seen by all variants in order.
struct Job {
  SourceFactory open;
  int first, last;
  std::vector<Variant> variants;
  std::string name;
  std::vector<Judged> judged;
  std::vector<TrueJoint> joints;
  std::vector<LearnedRun> learned;  ///< of each variant; empty where frames are independent
};

void writeFailures(const Frame& frame, const StereoCamera& camera, const std::vector<Judged>& judged,
                   const std::vector<DetectedRectangle>& rectangles, const std::string& folder) {
  for (const Judged& row : judged) {
    if (row.score.detected || folder.empty()) continue;
    const auto front =
        std::find_if(frame.fronts.begin(), frame.fronts.end(), [&](const Front& front) { return front.name == row.front; });
    std::string name = row.source + "_" + row.variant + "_" + row.front + "_" + std::to_string(row.frame);
    std::replace(name.begin(), name.end(), '/', '-');
    cv::imwrite(folder + "/" + name + ".png", drawFailure(frame, camera, front->rectangle, rectangles, row.score));
  }
}

void runJob(const std::string& failures, Job* job) {
  const std::unique_ptr<FrameSource> source = job->open();
  job->name = source->name();
  std::vector<Observer> observers(job->variants.begin(), job->variants.end());
  if (!source->independent()) job->learned.resize(observers.size());
  std::vector<Frame> frames;
  for (int i = job->first; i < std::min(job->last, source->size()); ++i) {
    frames.push_back(source->frame(i));
    Frame& frame = frames.back();
    for (std::size_t k = 0; k < observers.size(); ++k) {
      if (source->independent()) observers[k].forget();
      const PipelineResult seen = observers[k].see(frame, source->camera());
      std::vector<Judged> judged = judge(frame, seen);
      for (Judged& row : judged) {
        row.source = source->name();
        row.variant = observers[k].name();
        row.frame = i;
      }
      writeFailures(frame, source->camera(), judged, seen.rectangles, failures);
      job->judged.insert(job->judged.end(), judged.begin(), judged.end());
      if (!source->independent()) job->learned[k].add(seen.models);
    }
    frame.releaseImages();
  }
  if (!source->independent()) job->joints = findJoints(frames);
}

void addJobs(const SourceFactory& open, std::vector<Job>* jobs) {
  constexpr int kBlock = 25;  // independent frames need not be seen by one thread
  const std::unique_ptr<FrameSource> source = open();
  const int step = source->independent() ? kBlock : source->size();
  std::vector<Variant> variants{ourVariant(), paperVariant()};
  // A depth image in place of the pair is what `ours` sees anyway.
  if (source->size() > 0 && source->frame(0).depth.empty()) variants.insert(variants.begin() + 1, depthVariant());
  for (int first = 0; first < source->size(); first += step)
    jobs->push_back({open, first, first + step, variants, {}, {}, {}, {}});
}

std::vector<Job> makeJobs(const Options& options) {
  std::vector<Job> jobs;
  const int poses = options.count("poses"), seed = options.count("seed");
  if (poses > 0) addJobs([=] { return simulateHangingDrawer(poses, seed); }, &jobs);
  for (int i = 0; i < options.count("scenes"); ++i)
    for (const char* scene : {"door", "drawer", "pedestal", "static"})
      for (const double motion : {0.0, kCameraMotion}) {
        SimulationConfig config;
        config.scene = scene;
        config.scene_seed = seed + i;
        config.camera_motion = motion;
        addJobs([=] { return simulateRun(config); }, &jobs);
      }
  for (const std::string& folder : findSequences(options.text("sequences"), false))
    addJobs([=] { return openRecordedSequence(folder); }, &jobs);
  return jobs;
}

/// The columns of one joint, from its name on; none of them for a run in which nothing moves.
constexpr char kLearnedHeader[] =
    "source,variant,objects_moving,front,type,learned,probability,right_from_mm,axis_deg,axis_mm,predicted_mm_mean,"
    "predicted_mm_max,predicted_deg_mean";
constexpr int kJointColumns = 10;

void writeLearned(const Job& job, CsvWriter* csv) {
  for (std::size_t k = 0; k < job.learned.size(); ++k) {
    const std::string& variant = job.variants[k].name;
    const LearnedRun& run = job.learned[k];
    if (job.joints.empty()) csv->row(job.name, variant, run.movers(), std::vector<double>(kJointColumns, std::nan("")));
    for (const TrueJoint& joint : job.joints) {
      const std::optional<LearnedJoint> learned = run.find(joint);
      const auto of = [&](auto value) { return learned ? value(*learned) : std::nan(""); };
      csv->row(
          job.name, variant, run.movers(), joint.name, modelName(joint.type), learned ? selectedName(learned->model) : "none",
          of([](const LearnedJoint& l) { return l.model.probabilities[static_cast<std::size_t>(l.model.type)]; }),
          of([](const LearnedJoint& l) { return 1e3 * l.right_from.value_or(std::nan("")); }),
          of([](const LearnedJoint& l) { return toDegrees(l.axis_angle); }),
          joint.type == JointType::kRotational ? of([](const LearnedJoint& l) { return 1e3 * l.axis_distance; }) : std::nan(""),
          of([](const LearnedJoint& l) { return 1e3 * l.prediction.position; }),
          of([](const LearnedJoint& l) { return 1e3 * l.prediction.position_max; }),
          of([](const LearnedJoint& l) { return toDegrees(l.prediction.orientation); }));
    }
  }
}

int run(int argc, char** argv) {
  const Options options(argc, argv, {{"poses", "500"}, {"scenes", "1"}, {"seed", "1"}, {"sequences", ""}, {"failures", ""}});
  const std::string failures = options.text("failures");
  if (!failures.empty()) std::filesystem::create_directories(failures);
  cv::setNumThreads(1);  // the cores work on different frames
  std::vector<Job> jobs = makeJobs(options);
  parallelFor(static_cast<int>(jobs.size()), [&](int i) { runJob(failures, &jobs[i]); });
  CsvWriter learned(options.out("fig11_learned.csv"), kLearnedHeader);
  std::vector<Judged> judged;
  for (Job& job : jobs) {
    std::move(job.judged.begin(), job.judged.end(), std::back_inserter(judged));
    writeLearned(job, &learned);
  }
  writeDetectionTables(judged, options.out("fig11"));
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation

int main(int argc, char** argv) {
  return cabinet_articulation::runProgram("fig11_detection", "",
                                          [&] { return cabinet_articulation::core::evaluation::run(argc, argv); });
}
