// SPDX-License-Identifier: BSD-3-Clause
// A recorded pair or disparity as a depth camera would give it: whole millimetres, no images. To see what such a camera costs.
#include <rosbag/view.h>

#include <cstdio>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "ros/messages/simulation_conversions.h"
#include "stereo/whole_millimetres.h"
#include "tools/input/bag_tool_options.h"
#include "tools/terminal/progress.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: depth_bag IN.bag OUT.bag [options]\n"
    "writes /camera/depth/image_raw (16UC1) and /camera/depth/camera_info, and copies /tf and /tf_static\n"
    "  --config DIR        stereo.yaml; a missing file means the defaults\n";

core::StereoConfig loadConfig(const std::string& directory) {
  if (directory.empty()) return {};
  std::vector<std::string> warnings;
  const core::PipelineConfig config = core::PipelineConfig::load(directory, &warnings);
  for (const std::string& warning : warnings) std::fprintf(stderr, "depth_bag: %s\n", warning.c_str());
  return config.stereo;
}

void copyTransforms(const rosbag::Bag& from, rosbag::Bag* to) {
  for (const rosbag::MessageInstance& message :
       rosbag::View(from, rosbag::TopicQuery(std::vector<std::string>{"/tf", "/tf_static"})))
    to->write(message.getTopic(), message.getTime(), message, message.getConnectionHeader());
}

int run(const BagToolOptions& options) {
  const core::StereoConfig config = loadConfig(options.config);
  FrameBagOptions bag = options.bag;
  bag.leave_out_unlit = config.leave_out_unlit;
  FrameBag input(options.input, bag);
  core::BlockMatcher matcher(config);
  rosbag::Bag output(options.output, rosbag::bagmode::Write);
  copyTransforms(input.bag(), &output);
  Progress progress(input.expectedFrames());
  SkippedFrames skipped;
  int frames = 0;
  const auto write = [&](const std_msgs::Header& header, const FrameViews& views) {
    const core::DepthFrame& frame = views.frame;
    const cv::Mat1w depth =
        core::wholeMillimetres(frame.disparity.empty() ? matcher.process(frame.left, frame.right, frame.camera) : frame);
    output.write("/camera/depth/camera_info", header.stamp, toLeftCameraInfo(frame.camera, header));
    output.write("/camera/depth/image_raw", header.stamp, cv_bridge::CvImage(header, "16UC1", depth).toImageMsg());
    ++frames;
    progress.show(input.framesRead());
  };
  input.forEachFrame(write, &skipped);
  output.close();
  progress.clear();
  std::fprintf(stderr, "%s", skipped.text().c_str());
  if (frames == 0) throw std::runtime_error(options.input + ": no frame could be converted");
  std::printf("%d frames of %s\n", frames, options.input.c_str());
  return 0;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  const std::string usage = std::string(kUsage) + kBagInputUsage;
  return runProgram("depth_bag", usage.c_str(), [&] {
    BagToolOptions options;
    if (parseBagToolOptions(argc, argv, {}, &options)) return run(options);
    std::printf("%s", usage.c_str());
    return 0;
  });
}
