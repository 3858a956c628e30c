// SPDX-License-Identifier: BSD-3-Clause
// Every frame of a bag through the pipeline, without a ROS master: what it finds goes to another bag, with the stamps of
// the input. The same bag gives the same bytes.
#include <getopt.h>
#include <tf2/exceptions.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "cabinet_articulation/ros/conversions.h"
#include "ros/clock_jump.h"
#include "tools/bag_transforms.h"
#include "tools/frame_bag.h"
#include "tools/result_bag.h"
#include "tools/run_program.h"
#include "tools/run_summary.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: process_bag IN.bag OUT.bag [options]\n"
    "  --config DIR        stereo.yaml, planes.yaml, ...; a missing file means that stage's defaults\n"
    "  --fixed-frame FRAME all poses in this frame, by the bag's tf (default: the left camera's optical frame)\n"
    "  --camera-rectangles rectangles in the camera's frame, as the nodelets publish them\n"
    "  --input KIND        stereo (default), disparity or depth\n"
    "                      images of a pair have equal stamps; depth is that of a pair with the default virtual_baseline\n"
    "  --camera NAMESPACE  of the input's topics (default: /stereo), else the only ones below it that fit; they are for\n"
    "                      stereo: left/, right/ image_raw or image_rect, and camera_info;\n"
    "                      disparity: disparity, left/camera_info; right/camera_info and left/, right/ image_rect if there;\n"
    "                      depth: depth/image and depth/camera_info\n";

struct Options {
  std::string input, output, config, fixed_frame;
  std::string kind = "stereo", camera;
  bool camera_rectangles = false;
};

/// Throws std::invalid_argument. Nothing if only help was asked for.
std::optional<Options> parseOptions(int argc, char** argv) {
  Options options;
  const option known[] = {{"config", required_argument, nullptr, 'c'},
                          {"fixed-frame", required_argument, nullptr, 'f'},
                          {"input", required_argument, nullptr, 'i'},
                          {"camera", required_argument, nullptr, 's'},
                          {"camera-rectangles", no_argument, nullptr, 'r'},
                          {"help", no_argument, nullptr, 'h'},
                          {nullptr, 0, nullptr, 0}};
  opterr = 0;
  for (int choice; (choice = getopt_long(argc, argv, "h", known, nullptr)) != -1;) {
    if (choice == 'h') return std::nullopt;
    if (choice == '?') throw std::invalid_argument(std::string("unknown option or missing value: ") + argv[optind - 1]);
    if (choice == 'r')
      options.camera_rectangles = true;
    else
      (choice == 'c'   ? options.config
       : choice == 'f' ? options.fixed_frame
       : choice == 'i' ? options.kind
                       : options.camera) = optarg;
  }
  if (argc - optind != 2) throw std::invalid_argument("expected two bags, got " + std::to_string(argc - optind));
  options.input = argv[optind];
  options.output = argv[optind + 1];
  if (!options.camera.empty() && options.camera[0] != '/') options.camera = "/" + options.camera;
  std::error_code missing;
  if (std::filesystem::equivalent(options.input, options.output, missing))
    throw std::invalid_argument("input and output are the same file: " + options.input);
  return options;
}

core::PipelineConfig loadConfig(const Options& options) {
  std::vector<std::string> warnings;
  const core::PipelineConfig config =
      options.config.empty() ? core::PipelineConfig() : core::PipelineConfig::load(options.config, &warnings);
  for (const std::string& warning : warnings) std::fprintf(stderr, "process_bag: %s\n", warning.c_str());
  return config;
}

/// Takes one frame after the other through the pipeline and into the output.
class Run {
 public:
  explicit Run(const Options& options)
      : options_(options), input_(options.input, options.kind, options.camera), pipeline_(loadConfig(options)) {
    if (options.fixed_frame.empty()) return;
    transforms_.emplace(input_.bag());
    if (!transforms_->leftOut().empty())
      std::fprintf(stderr, "process_bag: %s; it is left out\n", transforms_->leftOut().c_str());
  }

  void processAll() {
    input_.forEachFrame([this](const auto& header, const FrameViews& views) { process(header, views.frame); }, &skipped_);
    if (output_) output_->close(header_, pipeline_.tracks());
  }

  const RunSummary& summary() const { return summary_; }
  const SkippedFrames& skipped() const { return skipped_; }

 private:
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
    const double stamp = header.stamp.toSec();
    const core::PipelineResult result = frame.disparity.empty()
                                            ? pipeline_.process(stamp, frame.left, frame.right, frame.camera, T_fixed_camera)
                                            : pipeline_.process(stamp, frame, T_fixed_camera);
    summary_.add(result);
    if (!output_) output_.emplace(options_.output);
    const RectangleArray rectangles = options_.camera_rectangles
                                          ? toMessage(result.rectangles, camera)
                                          : toMessage(core::transformed(result.rectangles, T_fixed_camera), header);
    output_->write(header, rectangles, result.track_updates, result.models);
  }

  /// True for a frame that may be processed: newer than the last one, or after a clock that jumped back (a bag in a loop).
  bool isNewer(const ros::Time& stamp) {
    const std::optional<ros::Time> newest = clock_jump_.newest();
    const FrameOrder order = clock_jump_.orderOf(stamp);
    if (order != FrameOrder::kSetBack) return order == FrameOrder::kNewer;
    std::fprintf(stderr, "process_bag: time jumped back from %f to %f, joints stay known, all else is forgotten\n",
                 newest->toSec(), stamp.toSec());
    pipeline_.startAfresh();
    return true;
  }

  Options options_;
  FrameBag input_;
  core::Pipeline pipeline_;
  std::optional<BagTransforms> transforms_;
  std::optional<ResultBag> output_;
  RunSummary summary_;
  SkippedFrames skipped_;
  ClockJump clock_jump_;
  std_msgs::Header header_;  ///< of the last frame processed
};

int run(const Options& options) {
  Run run(options);
  std::string failure;
  try {
    run.processAll();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  std::fprintf(stderr, "%s", run.skipped().text().c_str());
  if (run.summary().frames() > 0)
    std::printf("%d frames of %s\n%s%s", run.summary().frames(), options.input.c_str(), run.summary().objects().c_str(),
                run.summary().timing().c_str());
  if (failure.empty() && run.summary().frames() == 0) failure = options.input + ": no frame could be processed";
  if (!failure.empty()) std::fprintf(stderr, "process_bag: %s\n", failure.c_str());
  return failure.empty() ? 0 : 1;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  return runProgram("process_bag", kUsage, [&] {
    const auto options = parseOptions(argc, argv);
    if (options) return run(*options);
    std::printf("%s", kUsage);
    return 0;
  });
}
