// SPDX-License-Identifier: BSD-3-Clause
// Every frame of a bag through the pipeline, without a ROS master: what it finds goes to another bag, with the stamps of
// the input. The same bag gives the same bytes.
#include <getopt.h>
#include <tf2/exceptions.h>

#include <cstdio>
#include <filesystem>
#include <optional>

#include "bag_transforms.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "rectifier.h"
#include "result_bag.h"
#include "run_program.h"
#include "run_summary.h"
#include "stereo_bag.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: process_bag IN.bag OUT.bag [options]\n"
    "  --config DIR        stereo.yaml, planes.yaml, ...; a missing file means that stage's defaults\n"
    "  --fixed-frame FRAME all poses in this frame, by the bag's tf (default: the left camera's optical frame)\n"
    "  --camera-rectangles rectangles in the camera's frame, as the nodelets publish them\n"
    "  --camera NAMESPACE  of left/, right/ image_raw or image_rect, and camera_info (default: /stereo)\n";

struct Options {
  std::string input, output, config, fixed_frame;
  std::string camera = "/stereo";
  bool camera_rectangles = false;
};

/// Throws std::invalid_argument. Nothing if only help was asked for.
std::optional<Options> parseOptions(int argc, char** argv) {
  Options options;
  const option known[] = {{"config", required_argument, nullptr, 'c'},
                          {"fixed-frame", required_argument, nullptr, 'f'},
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
      (choice == 'c' ? options.config : choice == 'f' ? options.fixed_frame : options.camera) = optarg;
  }
  if (argc - optind != 2) throw std::invalid_argument("expected two bags, got " + std::to_string(argc - optind));
  options.input = argv[optind];
  options.output = argv[optind + 1];
  if (options.camera.empty() || options.camera[0] != '/') options.camera = "/" + options.camera;
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

/// Takes one pair after the other through the pipeline and into the output.
class Run {
 public:
  explicit Run(const Options& options)
      : options_(options), input_(options.input, options.camera), pipeline_(loadConfig(options)) {
    if (!options.fixed_frame.empty()) transforms_.emplace(input_.bag());
  }

  void processAll() {
    input_.forEachPair([this](const StereoPair& pair) { process(pair); }, &skipped_);
    if (output_) output_->close(header_, pipeline_.tracks());
  }

  const RunSummary& summary() const { return summary_; }
  const SkippedFrames& skipped() const { return skipped_; }

 private:
  void process(const StereoPair& pair) {
    const std::string stamp = std::to_string(pair.left->header.stamp.toSec());
    if (!sizesAgree(pair)) return skipped_.add("left and right image and their CameraInfos differ in size", sizesText(pair));
    if (!isNewer(pair.left->header.stamp)) return skipped_.add("the stamp is not newer than the frame's before", stamp);
    std_msgs::Header header = pair.left->header;
    Eigen::Isometry3d T_fixed_camera = Eigen::Isometry3d::Identity();
    if (transforms_) {
      header.frame_id = options_.fixed_frame;
      try {
        T_fixed_camera = transforms_->lookup(options_.fixed_frame, pair.left->header.frame_id, header.stamp);
      } catch (const tf2::TransformException& error) {
        return skipped_.add("no transform from '" + pair.left->header.frame_id + "' to '" + options_.fixed_frame + "'",
                            error.what());
      }
    }
    header_ = header;
    const core::StereoCamera camera = toStereoCamera(*pair.left_info, *pair.right_info, input_.infoTopic(0), input_.infoTopic(1));
    const auto left = toMono(pair.left, input_.imageTopic(0));
    const auto right = toMono(pair.right, input_.imageTopic(1));
    const core::PipelineResult result = pipeline_.process(header.stamp.toSec(), rectified(0, left->image, *pair.left_info),
                                                          rectified(1, right->image, *pair.right_info), camera, T_fixed_camera);
    summary_.add(result);
    if (!output_) output_.emplace(options_.output);
    const RectangleArray rectangles = options_.camera_rectangles
                                          ? toMessage(result.rectangles, pair.left->header)
                                          : toMessage(core::transformed(result.rectangles, T_fixed_camera), header);
    output_->write(header, rectangles, result.track_updates, result.models);
  }

  cv::Mat rectified(int side, const cv::Mat& image, const sensor_msgs::CameraInfo& info) {
    return input_.rectified() ? image : rectifiers_[side](image, info);
  }

  bool sizesAgree(const StereoPair& pair) const {
    return pair.left->width == pair.right->width && pair.left->height == pair.right->height &&
           pair.left->width == pair.left_info->width && pair.left->height == pair.left_info->height &&
           pair.left->width == pair.right_info->width && pair.left->height == pair.right_info->height;
  }

  std::string sizesText(const StereoPair& pair) const {
    const auto text = [](auto& message) { return std::to_string(message.width) + "x" + std::to_string(message.height); };
    return "at " + std::to_string(pair.left->header.stamp.toSec()) + " images " + text(*pair.left) + " and " + text(*pair.right) +
           ", CameraInfos " + text(*pair.left_info) + " and " + text(*pair.right_info);
  }

  /// A clock that jumps back by more than a second starts anew (a bag that was recorded in a loop).
  bool isNewer(const ros::Time& stamp) {
    if (summary_.frames() == 0 || stamp > header_.stamp) return true;
    if (secondsBetween(stamp, header_.stamp) < 1) return false;
    std::fprintf(stderr, "process_bag: time jumped back from %f to %f, all tracks start anew\n", header_.stamp.toSec(),
                 stamp.toSec());
    pipeline_.reset();
    return true;
  }

  Options options_;
  StereoBag input_;
  core::Pipeline pipeline_;
  std::optional<BagTransforms> transforms_;
  std::optional<ResultBag> output_;
  Rectifier rectifiers_[2];
  RunSummary summary_;
  SkippedFrames skipped_;
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
