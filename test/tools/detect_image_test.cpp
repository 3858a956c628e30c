// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

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
  expect("depth.png overlay.png", "--fx is missing");
  expect("depth.png overlay.png --fx zero", "--fx is 'zero', expected a positive number");
  expect("depth.png overlay.png --fy -1", "--fy is '-1'");
  expect("depth.png --fx 500", "expected a depth image and an overlay");
  expect("depth.png overlay.png --fx 500 --bias 3", "unknown option");
  expect("missing.png overlay.png --fx 500", "missing.png: cannot be opened: there is no such file");
  expect("depth.png nowhere/overlay.png --fx 500", "cannot be written");
  cv::imwrite(path("color.png"), cv::Mat3b(10, 10));
  expect("color.png overlay.png --fx 500", "16 bit or floating point");
  EXPECT_EQ(run("--help").status, 0);
}

}  // namespace
}  // namespace cabinet_articulation
