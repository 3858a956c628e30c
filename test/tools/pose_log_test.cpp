// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/pose_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <sstream>

namespace cabinet_articulation::core {
namespace {

PoseLog read(const std::string& text) {
  std::istringstream in(text);
  return readPoseLog(in, "some.log");
}

/// The message with which a log is refused; empty if it is not.
std::string refusal(const std::string& text) {
  try {
    read(text);
  } catch (const PoseLogError& error) {
    return error.what();
  }
  return "";
}

TEST(PoseLog, ReadsPositions) {
  const PoseLog log = read("1 2 3\n\n  # comment\n\t4e-1 5 6 \r\n");
  EXPECT_EQ(log.columns, 3);
  ASSERT_EQ(log.track.observations.size(), 2u);
  EXPECT_EQ(log.track.observations[0].rectangle.center(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(log.track.observations[1].rectangle.center(), Eigen::Vector3d(0.4, 5, 6));
  EXPECT_LT(log.track.observations[0].stamp, log.track.observations[1].stamp);
  EXPECT_EQ(log.track.width, 0);
}

TEST(PoseLog, ReadsPoses) {
  const PoseLog log = read("1 2 3 0 0 0.7071 0.7071\n");
  EXPECT_EQ(log.columns, 7);
  const Eigen::Isometry3d& pose = log.track.observations.at(0).rectangle.pose;
  EXPECT_LT((pose * Eigen::Vector3d::UnitX() - Eigen::Vector3d(1, 3, 3)).norm(), 1e-3);
  EXPECT_TRUE((pose.linear() * pose.linear().transpose()).isIdentity(1e-12)) << "normalised";
}

TEST(PoseLog, RectanglesAreGivenByACorner) {
  const PoseLog log = read("1 2 3 0 0 0 1 0.4 0.6\n1 2 3 0 0 0 -1 0.5 0.6\n1 2 3 0 0 0 1 0.4 0.8\n");
  EXPECT_EQ(log.columns, 9);
  EXPECT_TRUE(log.track.observations[0].rectangle.center().isApprox(Eigen::Vector3d(1.2, 2.3, 3)));
  EXPECT_TRUE(log.track.observations[1].rectangle.center().isApprox(Eigen::Vector3d(1.25, 2.3, 3)));
  EXPECT_EQ(log.track.width, 0.4);
  EXPECT_EQ(log.track.height, 0.6);
}

TEST(PoseLog, MeansOfQuaternionsAreNormalisedWithAWarning) {
  const PoseLog log = read("1 2 3 0 0 0 1\n1 2 3 0 0 0.6 0.6\n1 2 3 0 0 0 0.9\n");
  EXPECT_NEAR(log.track.observations[1].rectangle.pose.linear()(0, 1), -1, 1e-12);
  EXPECT_EQ(
      log.warning,
      "2 quaternions are not of length 1, as means of some are not, and were normalised; the shortest, in line 2, has length "
      "0.848528");
  EXPECT_EQ(read("1 2 3 0 0 0 0.99\n").warning, "");
}

TEST(PoseLog, RefusalsNameFileAndLine) {
  EXPECT_EQ(refusal(""), "some.log: no poses, expected one a line");
  EXPECT_EQ(refusal("\n# nothing\n"), "some.log: no poses, expected one a line");
  EXPECT_EQ(refusal("1 2\n"), "some.log:1: 2 columns, expected 3 (x y z), 7 (+ qx qy qz qw) or 9 (+ width height)");
  EXPECT_EQ(refusal("1 2 3\n\n1 2\n"), "some.log:3: 2 columns, expected 3 as in the lines before");
  EXPECT_EQ(refusal("1 2 3 0 0 0 1\n1 2 3\n"), "some.log:2: 3 columns, expected 7 as in the lines before");
  EXPECT_EQ(refusal("1 2 x3\n"), "some.log:1: 'x3' is not a number");
  EXPECT_EQ(refusal("1 2 3\n1 nan 3\n"), "some.log:2: 'nan' is not finite");
  EXPECT_EQ(refusal("1 2 3\n1 inf 3\n"), "some.log:2: 'inf' is not finite");
  EXPECT_EQ(refusal("1 2 3 0 0 0 0\n"), "some.log:1: the quaternion qx qy qz qw has length 0.000000, expected 1");
  EXPECT_EQ(refusal("1 2 3 0 0 0 2\n"), "some.log:1: the quaternion qx qy qz qw has length 2.000000, expected 1");
  EXPECT_EQ(refusal("1 2 3 0 0 0 1 0 0.6\n"), "some.log:1: width and height must be positive");
  EXPECT_EQ(refusal("1 2 3\n1 -1e154 3\n"), "some.log:2: position is (1, -1e+154, 3), expected -1e+08 to 1e+08 m");
  EXPECT_EQ(refusal("1 2 3 0 0 0 1 0.4 0.6\n1 2 3 0 0 0 1 1e18 0.6\n"),
            "some.log:2: width is 1e+18, expected 0.001 to 10 m, or 0: not known");
  EXPECT_EQ(refusal("1 2 3 0 0 0 1 0.4 1e-5\n"), "some.log:1: height is 1e-05, expected 0.001 to 10 m, or 0: not known");
}

TEST(PoseLog, IsAnOrdinaryFile) {
  const auto refusalOf = [](const std::string& path) {
    try {
      readPoseLog(path);
    } catch (const PoseLogError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusalOf("/no/such/file.log"), "/no/such/file.log: cannot be opened: there is no such file");
  EXPECT_EQ(refusalOf("/"), "/: is a folder, expected an ordinary file");
  EXPECT_EQ(refusalOf("/dev/zero"), "/dev/zero: is a device, expected an ordinary file");
  const std::string pipe = testing::TempDir() + "/pose_log_test." + std::to_string(::getpid());
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(refusalOf(pipe), pipe + ": is a pipe, expected an ordinary file");
  ::unlink(pipe.c_str());
}

TEST(PoseLog, ReadsWhatItWrote) {
  const PoseLog log = read("0.1 0.2 1.5 0 0.6 0 0.8 0.4 0.3\n0.1 0.2 1.4 0 0.6 0 0.8 0.41 0.29\n");
  std::stringstream text;
  writePoseLog(log.track, text);
  const PoseLog again = readPoseLog(text, "again");
  EXPECT_EQ(again.columns, 9);
  ASSERT_EQ(again.track.observations.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(again.track.observations[i].rectangle.pose.isApprox(log.track.observations[i].rectangle.pose, 1e-8));
    EXPECT_EQ(again.track.observations[i].rectangle.width, log.track.observations[i].rectangle.width);
    EXPECT_EQ(again.track.observations[i].rectangle.height, log.track.observations[i].rectangle.height);
  }
}

}  // namespace
}  // namespace cabinet_articulation::core
