// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "cabinet_articulation/stereo/block_matcher.h"

namespace cabinet_articulation {
namespace {

struct Outcome {
  int status;
  std::string text;
};

class DetectImage : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / ("detect_image_test_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory_);
    // A front of 40 x 20 cm, 1 m away, before a wall at 1.5 m; f = 500 px.
    cv::Mat1w depth(480, 640, std::uint16_t{1500});
    depth(cv::Rect(200, 180, 200, 100)) = 1000;
    cv::imwrite(path("depth.png"), depth);
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  Outcome run(const std::string& arguments) const {
    const int status =
        std::system(("cd " + directory_.string() + " && " DETECT_IMAGE " " + arguments + " > log.txt 2>&1").c_str());
    std::stringstream text;
    text << std::ifstream(path("log.txt")).rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str()};
  }

  std::filesystem::path directory_;
};

TEST_F(DetectImage, MeasuresAFrontAndDrawsIt) {
  const Outcome outcome = run("depth.png overlay.png --fx 500");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("2 plane regions"), std::string::npos) << outcome.text;
  EXPECT_NE(outcome.text.find("1 rectangles"), std::string::npos) << outcome.text;
  double width = 0, height = 0;
  const size_t line = outcome.text.find("region ", outcome.text.find("rectangles"));
  ASSERT_EQ(std::sscanf(outcome.text.c_str() + line, "region %*d: %lf x %lf m", &width, &height), 2) << outcome.text;
  // Edges lie between pixels of 2 mm, and either side may be called the width.
  EXPECT_NEAR(std::max(width, height), 0.4, 0.006);
  EXPECT_NEAR(std::min(width, height), 0.2, 0.006);
  const cv::Mat overlay = cv::imread(path("overlay.png"));
  ASSERT_EQ(overlay.size(), cv::Size(640, 480));
  EXPECT_GT(cv::norm(overlay.at<cv::Vec3b>(100, 100), overlay.at<cv::Vec3b>(230, 300)), 20) << "two regions, two colours";
}

TEST_F(DetectImage, ScalesSixteenBitValues) {
  const Outcome outcome = run("depth.png overlay.png --fx 500 --scale 500");
  EXPECT_NE(outcome.text.find("3.00 m from the camera"), std::string::npos) << outcome.text;
}

TEST_F(DetectImage, SaysWhatIsWrong) {
  const auto expect = [this](const std::string& arguments, const std::string& words) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 1) << arguments;
    EXPECT_NE(outcome.text.find(words), std::string::npos) << arguments << '\n' << outcome.text;
  };
  expect("depth.png overlay.png", "--fx or --camera-info is missing");
  expect("depth.png overlay.png --fx zero", "--fx is 'zero', expected a positive number");
  expect("depth.png overlay.png --fy -1", "--fy is '-1'");
  expect("depth.png --fx 500", "expected one or two images and an overlay, got 1 files");
  expect("depth.png overlay.png --fx 500 --bias 3", "unknown option");
  expect("missing.png overlay.png --fx 500", "missing.png: cannot be opened: there is no such file");
  expect("depth.png nowhere/overlay.png --fx 500", "cannot be written");
  cv::imwrite(path("color.png"), cv::Mat3b(10, 10));
  expect("color.png overlay.png --fx 500", "16 bit or floating point");
  EXPECT_EQ(run("--help").status, 0);
}

class DetectImageOfACamera : public DetectImage {
 protected:
  DetectImageOfACamera() : simulation_(door()) {}

  static core::SimulationConfig door() {
    core::SimulationConfig config;
    config.scene = "door";
    return config;
  }

  /// As camera_calibration writes it.
  void writeCalibration(const std::string& name, double baseline) const {
    const core::StereoCamera& camera = simulation_.camera();
    const auto matrix = [](const char* key, int columns, const std::string& data) {
      return std::string(key) + ":\n  rows: 3\n  cols: " + std::to_string(columns) + "\n  data: [" + data + "]\n";
    };
    const std::string fx = std::to_string(camera.fx), cx = std::to_string(camera.cx), cy = std::to_string(camera.cy);
    std::ofstream(path(name)) << "image_width: " << camera.width << "\nimage_height: " << camera.height << "\ncamera_name: c\n"
                              << matrix("camera_matrix", 3, fx + ", 0, " + cx + ", 0, " + fx + ", " + cy + ", 0, 0, 1")
                              << "distortion_model: plumb_bob\n"
                              << "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0, 0, 0, 0, 0]\n"
                              << matrix("rectification_matrix", 3, "1, 0, 0, 0, 1, 0, 0, 0, 1")
                              << matrix("projection_matrix", 4,
                                        fx + ", 0, " + cx + ", " + std::to_string(-camera.fx * baseline) + ", 0, " + fx + ", " +
                                            cy + ", 0, 0, 0, 1, 0");
  }

  /// The lines about rectangles.
  std::string rectangles(const std::string& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    const size_t begin = outcome.text.find(" rectangles\n");
    return begin == std::string::npos ? outcome.text : outcome.text.substr(begin - 1);
  }

  core::SimulatedStereoCamera simulation_;
};

TEST_F(DetectImageOfACamera, TakesACalibrationInsteadOfNumbers) {
  const core::StereoCamera& camera = simulation_.camera();
  writeCalibration("camera.yaml", 0);
  const std::string numbers =
      "--fx " + std::to_string(camera.fx) + " --cx " + std::to_string(camera.cx) + " --cy " + std::to_string(camera.cy);
  EXPECT_EQ(rectangles("depth.png overlay.png --camera-info camera.yaml"), rectangles("depth.png overlay.png " + numbers));
  std::ofstream(path("bad.yaml")) << "image_width: 640\n";
  const Outcome outcome = run("depth.png overlay.png --camera-info bad.yaml");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.text.find("bad.yaml: no calibration, expected a YAML file"), std::string::npos) << outcome.text;
}

TEST_F(DetectImageOfACamera, TakesAPairOrItsDisparity) {
  const core::StereoFrame frame = simulation_.frame(60);
  cv::imwrite(path("left.png"), frame.left);
  cv::imwrite(path("right.png"), frame.right);
  const cv::Mat1f disparity =
      core::BlockMatcher(core::StereoConfig()).process(frame.left, frame.right, simulation_.camera()).disparity;
  cv::imwrite(path("disparity.tiff"), disparity);
  cv::Mat1w sixteenths;
  disparity.convertTo(sixteenths, CV_16U, 16);
  cv::imwrite(path("disparity.png"), sixteenths);
  writeCalibration("left.yaml", 0);
  writeCalibration("right.yaml", simulation_.camera().baseline);
  const std::string infos = " overlay.png --camera-info left.yaml --right-info right.yaml";
  const std::string pair = rectangles("left.png right.png" + infos);
  EXPECT_NE(pair.find("1 rectangles\n"), std::string::npos) << pair;
  // Without the images, edges are not refined.
  const std::string alone = rectangles("disparity.tiff --input disparity" + infos);
  EXPECT_NE(alone.find("1 rectangles\n"), std::string::npos) << alone;
  EXPECT_NE(alone, pair);
  EXPECT_EQ(rectangles("disparity.png --input disparity --scale 16" + infos), alone);
  const core::StereoCamera& camera = simulation_.camera();
  EXPECT_EQ(rectangles("left.png right.png overlay.png --fx " + std::to_string(camera.fx) + " --cx " + std::to_string(camera.cx) +
                       " --cy " + std::to_string(camera.cy) + " --baseline " + std::to_string(camera.baseline)),
            pair);
}

TEST_F(DetectImageOfACamera, SaysWhatAPairNeeds) {
  cv::imwrite(path("left.png"), simulation_.frame(0).left);
  EXPECT_NE(run("left.png left.png overlay.png --fx 690").text.find("--baseline or --right-info is missing"), std::string::npos);
  EXPECT_NE(run("left.png overlay.png --fx 690 --input stereo").text.find("expected 2 images of the input stereo, got 1"),
            std::string::npos);
  EXPECT_NE(run("left.png overlay.png --fx 690 --input sonar").text.find("input is 'sonar', expected depth, disparity or stereo"),
            std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation
