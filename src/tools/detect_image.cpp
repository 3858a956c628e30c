// SPDX-License-Identifier: BSD-3-Clause
// The planes and rectangles of a single depth image, as a picture and in words: does this camera see my cabinet?
#include <getopt.h>

#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "config/ordinary_file.h"
#include "ros/overlay.h"
#include "tools/run_program.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] =
    "usage: detect_image DEPTH OVERLAY.png --fx PX [options]\n"
    "  DEPTH            16 bit (see --scale) or floating point [m], 0 or NaN where nothing was measured\n"
    "  --fx, --fy PX    focal lengths (fy: as fx)\n"
    "  --cx, --cy PX    principal point (the image's centre)\n"
    "  --scale N        16 bit values per metre (1000)\n"
    "  --config DIR     planes.yaml and rectangles.yaml; a missing file means that stage's defaults\n";

constexpr double kVirtualBaseline = 0.075;  ///< [m] a depth sensor's usual one; turns depth into disparity

struct Options {
  std::string depth, overlay, config;
  double fx = 0, fy = 0, cx = -1, cy = -1, scale = 1000;
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
  const option known[] = {{"fx", required_argument, nullptr, 0},    {"fy", required_argument, nullptr, 0},
                          {"cx", required_argument, nullptr, 0},    {"cy", required_argument, nullptr, 0},
                          {"scale", required_argument, nullptr, 0}, {"config", required_argument, nullptr, 'c'},
                          {"help", no_argument, nullptr, 'h'},      {nullptr, 0, nullptr, 0}};
  double* const numbers[] = {&options.fx, &options.fy, &options.cx, &options.cy, &options.scale};
  opterr = 0;
  int index = 0;
  for (int choice; (choice = getopt_long(argc, argv, "h", known, &index)) != -1;) {
    if (choice == 'h') return std::nullopt;
    if (choice == '?') throw std::invalid_argument(std::string("unknown option or missing value: ") + argv[optind - 1]);
    if (choice == 'c')
      options.config = optarg;
    else
      *numbers[index] = number(optarg, known[index].name);
  }
  if (argc - optind != 2)
    throw std::invalid_argument("expected a depth image and an overlay, got " + std::to_string(argc - optind));
  if (options.fx == 0) throw std::invalid_argument("--fx is missing");
  options.depth = argv[optind];
  options.overlay = argv[optind + 1];
  if (options.fy == 0) options.fy = options.fx;
  return options;
}

/// [m]
cv::Mat1f readDepth(const Options& options) {
  core::requireOrdinaryFile(options.depth);
  const cv::Mat image = cv::imread(options.depth, cv::IMREAD_UNCHANGED);
  if (image.empty()) throw std::runtime_error(options.depth + ": no image, or none that can be read");
  if (image.type() != CV_16UC1 && image.type() != CV_32FC1)
    throw std::runtime_error(options.depth + ": expected 1 channel with 16 bit or floating point");
  cv::Mat1f depth;
  image.convertTo(depth, CV_32F, image.type() == CV_16UC1 ? 1 / options.scale : 1);
  return depth;
}

core::StereoCamera cameraOf(const Options& options, const cv::Size& size) {
  const double cx = options.cx < 0 ? (size.width - 1) / 2.0 : options.cx;
  const double cy = options.cy < 0 ? (size.height - 1) / 2.0 : options.cy;
  return core::StereoCamera::fromDepthCamera(size.width, size.height, {options.fx, 0, cx, 0, options.fy, cy, 0, 0, 1},
                                             kVirtualBaseline);
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
  const cv::Mat1f depth = readDepth(options);
  const core::DepthFrame frame = core::frameFromDepth(depth, cameraOf(options, depth.size()));
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
