// SPDX-License-Identifier: BSD-3-Clause
// Every frame of a bag through the pipeline, without a ROS master. What it finds goes to another bag, with the stamps of the
// input. The same bag gives the same bytes.
#include <getopt.h>
#include <tf2/exceptions.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "cabinet_articulation/ros/conversions.h"
#include "pipeline/kept_bends.h"
#include "ros/checks/clock_jump.h"
#include "tools/input/bag_tool_options.h"
#include "tools/input/bag_transforms.h"
#include "tools/input/frame_bag.h"
#include "tools/report/run_report.h"
#include "tools/results/result_bag.h"
#include "tools/results/run_summary.h"
#include "tools/terminal/progress.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: process_bag IN.bag OUT.bag [options]\n"
    "  --config DIR        stereo.yaml, planes.yaml, ...; a missing file means that stage's defaults\n"
    "  --fixed-frame FRAME all poses in this frame, by the bag's tf (default: the left camera's optical frame)\n"
    "  --camera-rectangles rectangles in the camera's frame, as the nodelets publish them\n"
    "  --bend-file FILE    how depth cameras bend what is flat: read if it is there, saved at the end\n"
    "  --report FOLDER     writes FOLDER/index.html too, a page that shows what was seen and learned\n";

struct ProcessBagOptions : BagToolOptions {
  std::string fixed_frame;
  std::string bend_file;  ///< empty: none
  std::string report;     ///< folder; empty: none
  std::string command;    ///< as it was given
  bool camera_rectangles = false;
};

/// Nothing if only help was asked for.
std::optional<ProcessBagOptions> parseOptions(int argc, char** argv) {
  ProcessBagOptions options;
  const std::vector<Choice> own{
      {"fixed-frame", required_argument, [&options](const char* frame) { options.fixed_frame = frame; }},
      {"bend-file", required_argument, [&options](const char* file) { options.bend_file = file; }},
      {"report", required_argument, [&options](const char* folder) { options.report = folder; }},
      {"camera-rectangles", no_argument, [&options](const char*) { options.camera_rectangles = true; }}};
  for (int i = 0; i < argc; ++i) options.command += (i > 0 ? " " : "") + std::string(argv[i]);
  if (!parseBagToolOptions(argc, argv, own, &options)) return std::nullopt;
  return options;
}

core::PipelineConfig loadConfig(const ProcessBagOptions& options) {
  std::vector<std::string> warnings;
  const core::PipelineConfig config =
      options.config.empty() ? core::PipelineConfig() : core::PipelineConfig::load(options.config, &warnings);
  for (const std::string& warning : warnings) std::fprintf(stderr, "process_bag: %s\n", warning.c_str());
  return config;
}

FrameBagOptions bagOptions(const ProcessBagOptions& options, const core::PipelineConfig& config) {
  FrameBagOptions bag = options.bag;
  bag.leave_out_unlit = config.stereo.leave_out_unlit;
  return bag;
}

/// Takes one frame after the other through the pipeline and into the output.
class Run {
 public:
  explicit Run(const ProcessBagOptions& options)
      : options_(options),
        config_(loadConfig(options)),
        input_(options.input, bagOptions(options, config_)),
        progress_(input_.expectedFrames()),
        pipeline_(config_),
        matcher_(config_.stereo) {
    readBends(options.bend_file);
    if (!options.report.empty()) report_.emplace(options.report);
    if (options.fixed_frame.empty()) return;
    transforms_.emplace(input_.bag());
    if (!transforms_->leftOut().empty())
      std::fprintf(stderr, "process_bag: %s; it is left out\n", transforms_->leftOut().c_str());
  }

  void processAll() {
    input_.forEachFrame(
        [this](const auto& header, const FrameViews& views) {
          process(header, views.frame);
          progress_.show(input_.framesRead());
        },
        &skipped_);
    progress_.clear();
    if (output_) output_->close(header_, pipeline_.tracks());
    if (const core::SensorBend* bend = pipeline_.sensorBend()) kept_bends_.save(*bend);
  }

  /// `failure` is what ended the run before its time; empty if nothing did.
  void writeReport(const std::string& failure) {
    if (!report_ || summary_.frames() == 0) return;
    const RunFacts facts{
        options_.input,           options_.command, input_.input().kind, header_.frame_id, upwardsIn(options_.fixed_frame),
        skipped_.text() + failure};
    std::printf("report: %s\n", report_->write(facts, summary_).c_str());
  }

  /// What is known of the bend of a depth camera, a line; empty for a pair.
  std::string bend() const { return pipeline_.bend().empty() ? "" : pipeline_.bend() + "\n"; }

  const RunSummary& summary() const { return summary_; }
  const SkippedFrames& skipped() const { return skipped_; }

 private:
  void readBends(const std::string& file) {
    if (file.empty()) return;
    kept_bends_.read(file);
    if (!config_.planes.bend)
      std::fprintf(stderr, "process_bag: planes.yaml says bend: false, so '%s' is neither used nor written\n", file.c_str());
  }

  void process(const std_msgs::Header& camera, const core::DepthFrame& frame) {
    if (!isNewer(camera.stamp))
      return skipped_.add("the stamp is not newer than the frame's before", std::to_string(camera.stamp.toSec()));
    std_msgs::Header header = camera;
    Eigen::Isometry3d T_fixed_camera = Eigen::Isometry3d::Identity();
    if (transforms_) {
      header.frame_id = options_.fixed_frame;
      try {
        T_fixed_camera = transforms_->lookup(options_.fixed_frame, camera.frame_id, camera.stamp);
      } catch (const tf2::TransformException& error) {
        return skipped_.add("no transform from '" + camera.frame_id + "' to '" + options_.fixed_frame + "'", error.what());
      }
    }
    header_ = header;
    if (core::SensorBend* bend = pipeline_.sensorBend()) kept_bends_.follow(camera.frame_id, bend);
    const double stamp = header.stamp.toSec();
    const core::PipelineResult result = frame.disparity.empty()
                                            ? pipeline_.process(stamp, frame.left, frame.right, frame.camera, T_fixed_camera)
                                            : pipeline_.process(stamp, frame, T_fixed_camera);
    summary_.add(result);
    if (report_) report_->add(stamp, result, T_fixed_camera);
    warnIfSwapped(frame, result.frame);
    if (!output_) output_.emplace(options_.output);
    output_->write(header, rectanglesOf(result, camera, header, T_fixed_camera), tracksOf(result, header), result.models);
  }

  RectangleArray rectanglesOf(const core::PipelineResult& result, const std_msgs::Header& camera, const std_msgs::Header& fixed,
                              const Eigen::Isometry3d& T_fixed_camera) const {
    RectangleArray rectangles = options_.camera_rectangles
                                    ? toMessage(result.rectangles, camera)
                                    : toMessage(core::transformed(result.rectangles, T_fixed_camera), fixed);
    core::DepthView view = result.view;
    if (options_.camera_rectangles) view.T_fixed_camera.setIdentity();
    rectangles.view = toMessage(view);
    return rectangles;
  }

  static TrackArray tracksOf(const core::PipelineResult& result, const std_msgs::Header& header) {
    TrackArray tracks = toMessage(result.track_updates, header);
    tracks.view = toMessage(result.view);
    return tracks;
  }

  void warnIfSwapped(const core::DepthFrame& input, const core::DepthFrame& matched) {
    if (said_swapped_ || !input.disparity.empty() || !swap_.looksSwapped(matched, &matcher_)) return;
    said_swapped_ = true;
    progress_.clear();
    std::fprintf(stderr, "process_bag: at %f left and right image match only the other way round: are their topics swapped?\n",
                 header_.stamp.toSec());
  }

  /// True for a frame that may be processed: newer than the last one, or after a clock that jumped back (a bag in a loop).
  bool isNewer(const ros::Time& stamp) {
    const std::optional<ros::Time> newest = clock_jump_.newest();
    const FrameOrder order = clock_jump_.orderOf(stamp);
    if (order != FrameOrder::kSetBack) return order == FrameOrder::kNewer;
    progress_.clear();
    std::fprintf(stderr, "process_bag: time jumped back from %f to %f, joints stay known, all else is forgotten\n",
                 newest->toSec(), stamp.toSec());
    pipeline_.startAfresh();
    return true;
  }

  const ProcessBagOptions options_;
  const core::PipelineConfig config_;
  FrameBag input_;
  Progress progress_;
  core::Pipeline pipeline_;
  core::KeptBends kept_bends_;
  core::BlockMatcher matcher_;  ///< for pairs that are tried the other way round
  core::SwapWatch swap_;
  bool said_swapped_ = false;
  std::optional<BagTransforms> transforms_;
  std::optional<ResultBag> output_;
  std::optional<RunReport> report_;
  RunSummary summary_;
  SkippedFrames skipped_;
  ClockJump clock_jump_;
  std_msgs::Header header_;  ///< of the last frame processed
};

int run(const ProcessBagOptions& options) {
  Run run(options);
  std::string failure;
  try {
    run.processAll();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  std::fprintf(stderr, "%s", run.skipped().text().c_str());
  if (run.summary().frames() > 0)
    std::printf("%d frames of %s\n%s%s%s", run.summary().frames(), options.input.c_str(), run.summary().objects().c_str(),
                run.bend().c_str(), run.summary().timing().c_str());
  run.writeReport(failure);
  if (failure.empty() && run.summary().frames() == 0) failure = options.input + ": no frame could be processed";
  if (!failure.empty()) std::fprintf(stderr, "process_bag: %s\n", failure.c_str());
  return failure.empty() ? 0 : 1;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  const std::string usage = std::string(kUsage) + kBagInputUsage;
  return runProgram("process_bag", usage.c_str(), [&] {
    const auto options = parseOptions(argc, argv);
    if (options) return run(*options);
    std::printf("%s", usage.c_str());
    return 0;
  });
}
