// SPDX-License-Identifier: BSD-3-Clause
#include "sources/recorded_sequence.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

namespace cabinet_articulation::core::evaluation {
namespace {
namespace fs = std::filesystem;

const char* const kCalibration = R"({"left": {"width": 8, "height": 6, "P": [700,0,4,0, 0,700,3,0, 0,0,1,0]},
 "right": {"width": 8, "height": 6, "P": [700,0,4,-63, 0,700,3,0, 0,0,1,0]}})";

const char* const kTruth = R"({"frames": [{"stamp": 0.5, "T_world_left": [[1,0,0,7],[0,1,0,8],[0,0,1,9],[0,0,0,1]],
 "panels": [
 {"name": "door", "type": "rotational", "width": 0.4, "height": 0.6, "q": -0.5, "center": [0.1, 0.2, 1.5],
  "orientation_xyzw": [1, 0, 0, 0], "visible_fraction": 0.9, "in_image_fraction": 0.8, "front_faces_camera": false},
 {"name": "wall", "type": "rigid", "width": 1, "height": 1, "q": null, "center": [0, 0, 2],
  "orientation_xyzw": [1, 0, 0, 0]}]}]})";

class RecordedSequenceTest : public testing::Test {
 protected:
  RecordedSequenceTest()
      : folder_(fs::temp_directory_path() / ("recorded_sequence_test_" + std::to_string(getpid())) / "door_1") {
    fs::create_directories(folder_);
    write("calibration.json", kCalibration);
    write("truth.json", kTruth);
    cv::imwrite((folder_ / "left_0000.png").string(), cv::Mat(6, 8, CV_8UC1, cv::Scalar(10)));
    cv::imwrite((folder_ / "right_0000.png").string(), cv::Mat(6, 8, CV_8UC1, cv::Scalar(20)));
  }
  ~RecordedSequenceTest() override { fs::remove_all(folder_.parent_path()); }

  void write(const char* name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  std::string errorOfFirstFrame() const {
    try {
      openRecordedSequence(folder_.string())->frame(0);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(RecordedSequenceTest, ReadsImagesCalibrationAndTruth) {
  const auto sequence = openRecordedSequence(folder_.string() + "/");
  EXPECT_EQ(sequence->name(), "door_1");
  EXPECT_EQ(sequence->size(), 1);
  EXPECT_FALSE(sequence->independent());
  EXPECT_NEAR(sequence->camera().baseline, 0.09, 1e-12);
  const Frame frame = sequence->frame(0);
  EXPECT_EQ(frame.stamp, 0.5);
  EXPECT_EQ(frame.left(0, 0), 10);
  EXPECT_EQ(frame.right(0, 0), 20);
  EXPECT_TRUE(frame.T_world_camera.translation().isApprox(Eigen::Vector3d(7, 8, 9)));
  const Front& door = frame.fronts.at(0);
  EXPECT_EQ(door.type, JointType::kRotational);
  EXPECT_NEAR(door.opened, 0.2, 1e-12);  // 0.5 rad at 0.4 m
  EXPECT_TRUE(door.rectangle.normal().isApprox(-Eigen::Vector3d::UnitZ(), 1e-12));
  EXPECT_EQ(door.visible, 0.9);
  EXPECT_EQ(door.in_image, 0.8);
  EXPECT_FALSE(door.faces_camera);
  EXPECT_EQ(frame.fronts.at(1).opened, 0);
}

TEST_F(RecordedSequenceTest, ReadsDepthWhereThereIsNoPair) {
  fs::remove(folder_ / "left_0000.png");
  cv::imwrite((folder_ / "depth_0000.png").string(), cv::Mat(6, 8, CV_16UC1, cv::Scalar(1234)));
  const Frame frame = openRecordedSequence(folder_.string())->frame(0);
  EXPECT_EQ(frame.depth(0, 0), 1234);
  EXPECT_TRUE(frame.left.empty());
  cv::imwrite((folder_ / "depth_0000.png").string(), cv::Mat(6, 8, CV_8UC1, cv::Scalar(12)));
  EXPECT_NE(errorOfFirstFrame().find("depth_0000.png"), std::string::npos) << "not of 16 bits";
}

TEST_F(RecordedSequenceTest, ARotationThatWasRoundedIsARotationAllTheSame) {
  const std::string rounded = R"({"frames": [{"stamp": 0, "panels": [], "T_world_left":
    [[0.8776, -0.4794, 0, 0], [0.4794, 0.8776, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}]})";
  write("truth.json", rounded);
  const Eigen::Matrix3d R = openRecordedSequence(folder_.string())->frame(0).T_world_camera.linear();
  EXPECT_TRUE((R * R.transpose()).isIdentity(1e-14));
  EXPECT_NEAR(std::atan2(R(1, 0), R(0, 0)), 0.5, 1e-4);
}

TEST_F(RecordedSequenceTest, TakesTheCalibrationFromTheTruthIfItHasNoFile) {
  fs::remove(folder_ / "calibration.json");
  write("truth.json", std::string(R"({"calibration": )") + kCalibration + R"(, "frames": []})");
  EXPECT_NEAR(openRecordedSequence(folder_.string())->camera().baseline, 0.09, 1e-12);
  write("truth.json", kTruth);
  EXPECT_NE(errorOfFirstFrame().find("calibration"), std::string::npos);
}

TEST_F(RecordedSequenceTest, NamesTheFileThatIsWrong) {
  fs::remove(folder_ / "right_0000.png");
  EXPECT_NE(errorOfFirstFrame().find("right_0000.png"), std::string::npos);
  write("truth.json", R"({"frames": [{"stamp": 0}]})");
  EXPECT_NE(errorOfFirstFrame().find("truth.json"), std::string::npos);
  write("calibration.json", "{");
  EXPECT_NE(errorOfFirstFrame().find("calibration.json"), std::string::npos);
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
