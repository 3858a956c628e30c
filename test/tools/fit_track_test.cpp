// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
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

class FitTrack : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = std::filesystem::temp_directory_path() / ("fit_track_test_" + std::to_string(::getpid()));
    std::filesystem::create_directory(directory_);
    // A door of 40 cm that turns by 60 degrees, and a drawer that comes out by 30 cm.
    std::ofstream door(path("door.log")), drawer(path("drawer.log"));
    for (int i = 0; i <= 60; ++i) {
      const double angle = M_PI / 180 * i;
      door << 0.4 * std::cos(angle) << " 0 " << -0.4 * std::sin(angle) << '\n';
      drawer << "0.1 0.2 " << 1 - 0.005 * i << '\n';
    }
  }
  void TearDown() override { std::filesystem::remove_all(directory_); }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }

  Outcome run(const std::string& arguments) const {
    const int status = std::system(("cd " + directory_.string() + " && " FIT_TRACK " " + arguments + " > log.txt 2>&1").c_str());
    std::stringstream text;
    text << std::ifstream(path("log.txt")).rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text.str()};
  }

  /// Pixels of this colour (blue, green, red) in the left or the right half of the upper charts.
  static int count(const cv::Mat3b& image, const cv::Vec3b& color, bool right) {
    cv::Mat1b same;
    const int half = image.cols / 2;
    cv::inRange(image(cv::Rect(right ? half : 0, 90, half, image.rows / 2 - 90)), color, color, same);
    return cv::countNonZero(same);
  }

  std::filesystem::path directory_;
};

/// The lines without the milliseconds.
std::string withoutTimes(const std::string& text) {
  std::istringstream in(text);
  std::string kept;
  for (std::string line; std::getline(in, line);) kept += line.substr(0, line.rfind(',')) + '\n';
  return kept;
}

TEST_F(FitTrack, DrawsALogAndPrintsTheSame) {
  const Outcome plain = run("door.log");
  const Outcome drawn = run("door.log --plot door.png");
  ASSERT_EQ(drawn.status, 0) << drawn.text;
  EXPECT_EQ(withoutTimes(drawn.text), withoutTimes(plain.text));
  EXPECT_NE(drawn.text.find("door.log,rotational"), std::string::npos) << drawn.text;
  const cv::Mat3b image = cv::imread(path("door.png"));
  ASSERT_GT(image.cols, 1000);
  const cv::Vec3b vermilion(0, 94, 214), green(115, 158, 0);
  EXPECT_GT(count(image, vermilion, true), 5 * count(image, vermilion, false)) << "the axis is a dot from above, else a line";
  EXPECT_GT(count(image, green, false), 20) << "the way, between the dots";
}

TEST_F(FitTrack, DrawsADrawerInTheColourOfDrawers) {
  ASSERT_EQ(run("drawer.log --plot drawer.png").status, 0);
  const cv::Mat3b image = cv::imread(path("drawer.png"));
  const cv::Vec3b blue(178, 115, 0);
  EXPECT_GT(count(image, blue, false), 100);
  EXPECT_GT(count(image, blue, true), 100);
}

TEST_F(FitTrack, DrawsWhatDoesNotMoveAndASinglePose) {
  std::ofstream(path("still.log")) << "0 0 1\n0 0 1\n0 0 1\n";
  std::ofstream(path("one.log")) << "0 0 1\n";
  for (const char* name : {"still", "one"}) EXPECT_EQ(run(std::string(name) + ".log --plot " + name + ".png").status, 0) << name;
  EXPECT_FALSE(cv::imread(path("one.png")).empty());
}

TEST_F(FitTrack, SaysWhatIsWrongWithAPlot) {
  const auto expect = [this](const std::string& arguments, int status, const std::string& words) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, status) << arguments;
    EXPECT_NE(outcome.text.find(words), std::string::npos) << arguments << '\n' << outcome.text;
  };
  expect("door.log drawer.log --plot both.png", 2, "--plot draws one log, but 2 were given");
  expect("door.log --plot", 2, "--plot needs a file's name");
  expect("door.log --plot door.jpg", 2, "whose name ends with .png, not 'door.jpg'");
  expect("door.log --plot none/door.png", 1, "none/door.png cannot be written");
  expect("none.log --plot none.png", 1, "none.log");
  EXPECT_FALSE(std::filesystem::exists(path("none.png")));
}

/// The first quarter of a door's way, which slips by 2 mm, goes on as other doors did.
TEST_F(FitTrack, KnowsFromOtherLogsHowADoorGoesOn) {
  std::ofstream begun(path("begun.log"));
  for (int i = 0; i <= 20; ++i) {
    const double angle = M_PI / 180 * i, slip = 0.002 * std::sin(i / 20.0 * M_PI);
    begun << 1 + (0.4 - slip) * std::cos(angle) << " 1 " << -(0.4 - slip) * std::sin(angle) << '\n';
  }
  begun.close();
  const auto radius = [](const std::string& text) {
    std::istringstream line(text.substr(text.find("begun.log")));
    std::string cell;
    for (int i = 0; i < 6; ++i) std::getline(line, cell, ',');
    return std::atof(cell.c_str());
  };
  const Outcome alone = run("begun.log"), with_kinds = run("begun.log --kinds door.log --kinds door.log");
  EXPECT_EQ(with_kinds.status, 0) << with_kinds.text;
  EXPECT_NE(with_kinds.text.find("begun.log,rotational"), std::string::npos) << with_kinds.text;
  EXPECT_NEAR(radius(with_kinds.text), 0.4, 0.02) << with_kinds.text;
  EXPECT_GT(std::abs(radius(alone.text) - 0.4), 0.05) << alone.text;
}

TEST_F(FitTrack, SaysWhichLogTeachesNoKind) {
  std::ofstream(path("rest.log")) << "1 2 3\n1 2 3\n1 2 3\n";
  const Outcome outcome = run("door.log --kinds rest.log");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.text.find("rest.log teaches no kind"), std::string::npos) << outcome.text;
  const Outcome missing = run("door.log --kinds nowhere.log");
  EXPECT_EQ(missing.status, 2);
  EXPECT_NE(missing.text.find("--kinds: nowhere.log"), std::string::npos) << missing.text;
}

}  // namespace
}  // namespace cabinet_articulation
