// SPDX-License-Identifier: BSD-3-Clause
// The planes and rectangles of a single depth image, disparity image or pair, as a picture and in words: does this camera see my
// cabinet?
#include <getopt.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "ros/drawing/overlay.h"
#include "tools/input/image_input.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: detect_image DEPTH OVERLAY.png --fx PX [options]\n"
    "       detect_image LEFT RIGHT OVERLAY.png --camera-info LEFT.yaml --right-info RIGHT.yaml [options]\n"
    "  DEPTH               16 bit (see --scale) or floating point [m], 0 or NaN where nothing was measured\n"
    "  LEFT RIGHT          a pair; rectified, or with both calibrations\n"
    "  --input KIND        depth, disparity [px] or stereo (for one image: depth, for two: stereo)\n"
    "  --camera-info FILE  the camera's calibration (YAML, as from camera_calibration), or these numbers:\n"
    "  --fx, --fy PX       focal lengths (fy: as fx)\n"
    "  --cx, --cy PX       principal point (the image's centre)\n"
    "  --right-info FILE   stereo, disparity: calibration of the right camera, or\n"
    "  --baseline M        its distance from the left one\n"
    "  --scale N           16 bit values per metre (1000), or per pixel of disparity (256)\n"
    "  --config DIR        stereo.yaml, planes.yaml and rectangles.yaml; a missing file means that stage's defaults\n";

struct Options {
  ImageInput input;
  std::string overlay, config;
};

double number(const char* text, const std::string& name) {
  char* end = nullptr;
  const double value = std::strtod(text, &end);
  if (end == text || *end || !(value > 0))
    throw std::invalid_argument("--" + name + " is '" + text + "', expected a positive number");
  return value;
}

/// Throws std::invalid_argument. Nothing if only help was asked for.
std::optional<Options> parseOptions(int argc, char** argv) {
  Options options;
  ImageInput& input = options.input;
  const option known[] = {{"fx", required_argument, nullptr, 0},
                          {"fy", required_argument, nullptr, 0},
                          {"cx", required_argument, nullptr, 0},
                          {"cy", required_argument, nullptr, 0},
                          {"baseline", required_argument, nullptr, 0},
                          {"scale", required_argument, nullptr, 0},
                          {"config", required_argument, nullptr, 0},
                          {"input", required_argument, nullptr, 0},
                          {"camera-info", required_argument, nullptr, 0},
                          {"right-info", required_argument, nullptr, 0},
                          {"help", no_argument, nullptr, 'h'},
                          {nullptr, 0, nullptr, 0}};
  const std::vector<double*> numbers{&input.fx, &input.fy, &input.cx, &input.cy, &input.baseline, &input.scale};
  const std::vector<std::string*> texts{&options.config, &input.kind, &input.info, &input.right_info};
  opterr = 0;
  int found = 0;
  for (int choice; (choice = getopt_long(argc, argv, "h", known, &found)) != -1;) {
    if (choice == 'h') return std::nullopt;
    if (choice == '?') throw std::invalid_argument(std::string("unknown option or missing value: ") + argv[optind - 1]);
    const size_t index = static_cast<size_t>(found);
    if (index < numbers.size())
      *numbers[index] = number(optarg, known[index].name);
    else
      *texts[index - numbers.size()] = optarg;
  }
  if (argc - optind != 2 && argc - optind != 3)
    throw std::invalid_argument("expected one or two images and an overlay, got " + std::to_string(argc - optind) + " files");
  input.images.assign(argv + optind, argv + argc - 1);
  options.overlay = argv[argc - 1];
  return options;
}

/// The disparity in grey, each pixel tinted by the smallest region it lies in.
cv::Mat3b drawRegions(const core::DepthFrame& frame, const std::vector<core::PlaneRegion>& regions) {
  cv::Mat1b grey;
  cv::normalize(frame.disparity, grey, 40, 255, cv::NORM_MINMAX, CV_8U);
  cv::Mat3b picture;
  cv::cvtColor(grey, picture, cv::COLOR_GRAY2BGR);
  for (size_t i = 0; i < regions.size(); ++i) {
    cv::Mat3b color(1, 1, cv::Vec3b(static_cast<std::uint8_t>(i * 67 % 180), 160, 255));  // hues far apart
    cv::cvtColor(color, color, cv::COLOR_HSV2BGR);
    std::vector<cv::Point> hull(regions[i].hull.begin(), regions[i].hull.end());
    cv::Mat1b inside(picture.size(), std::uint8_t{0});
    cv::fillConvexPoly(inside, hull, 255);
    inside &= regions[i].mask == core::kInPlane;
    picture.setTo(color(0, 0), inside);
  }
  cv::Mat3b shaded;
  cv::cvtColor(grey, shaded, cv::COLOR_GRAY2BGR);
  cv::addWeighted(picture, 0.5, shaded, 0.5, 0, picture);
  return picture;
}

void print(const std::vector<core::PlaneRegion>& regions, const std::vector<core::DetectedRectangle>& rectangles) {
  std::printf("%zu plane regions\n", regions.size());
  for (size_t i = 0; i < regions.size(); ++i) {
    const Eigen::Vector3d& n = regions[i].plane.normal;
    std::printf("  %2zu: %6d px, normal (%.2f %.2f %.2f), %.2f m from the camera\n", i, regions[i].inliers, n.x(), n.y(), n.z(),
                regions[i].plane.offset);
  }
  std::printf("%zu rectangles\n", rectangles.size());
  for (const core::DetectedRectangle& detected : rectangles) {
    const Eigen::Vector3d p = detected.rectangle.center();
    std::printf("  region %2d: %.3f x %.3f m at (%.2f %.2f %.2f), precision %.2f, recall %.2f\n", detected.region,
                detected.rectangle.width, detected.rectangle.height, p.x(), p.y(), p.z(), detected.precision, detected.recall);
  }
}

void run(const Options& options) {
  std::vector<std::string> warnings;
  const core::PipelineConfig config =
      options.config.empty() ? core::PipelineConfig() : core::PipelineConfig::load(options.config, &warnings);
  for (const std::string& warning : warnings) std::fprintf(stderr, "detect_image: %s\n", warning.c_str());
  const core::DepthFrame frame = readFrame(options.input, config.stereo);
  const std::vector<core::PlaneRegion> regions = core::PlaneSegmenter(config.planes).process(frame);
  const std::vector<core::DetectedRectangle> rectangles =
      core::RectangleDetector(config.rectangles, config.planes).process(frame, regions);
  print(regions, rectangles);
  cv::Mat3b picture = drawRegions(frame, regions);
  drawOverlay(frame.camera, rectangles, {}, &picture);
  if (!cv::imwrite(options.overlay, picture)) throw std::runtime_error(options.overlay + ": cannot be written");
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  return runProgram("detect_image", kUsage, [&] {
    if (const auto options = parseOptions(argc, argv))
      run(*options);
    else
      std::printf("%s", kUsage);
    return 0;
  });
}
