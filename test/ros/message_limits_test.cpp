// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/ros_messages.h"

namespace cabinet_articulation {
namespace {

using test::errorOf;

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInf = std::numeric_limits<double>::infinity();

geometry_msgs::Pose somewhere() {
  geometry_msgs::Pose pose;
  pose.position.z = 1.5;
  pose.orientation.w = 1;
  return pose;
}

Rectangle goodRectangle() {
  Rectangle message;
  message.pose.pose = somewhere();
  message.width = 0.4;
  message.height = 0.3;
  return message;
}

Track goodTrack() {
  Track message;
  message.id = 1;
  message.poses = {somewhere()};
  message.stamps = {ros::Time(5)};
  message.covariances.assign(36, 0.1);
  return message;
}

Plane goodPlane() {
  Plane message;
  message.coefficients = {0, 0, -1, 1.2};
  message.disparity_plane = {0, 0, 20};
  message.inliers = 320 * 240;
  message.mask = test::greyImage(320, 240, {}, [](int, int) { return 255; });
  message.hull.resize(3);
  message.hull[1].x = 320;
  message.hull[2].y = 240;
  return message;
}

/// What is said of a good message after `spoil` changed it.
template <class Message>
std::string refusal(Message message, const std::function<void(Message&)>& spoil) {
  spoil(message);
  return errorOf([&] { fromMessage(message); });
}

/// Both ends of a limit are allowed; beyond, and what is not a number, is refused with its element, value and limit.
template <class Message>
void expectLimit(const Message& good, const std::function<void(Message&, double)>& set, const core::Limit& limit,
                 const char* element) {
  const auto said = [&](double value) { return refusal<Message>(good, [&](Message& message) { set(message, value); }); };
  EXPECT_EQ(said(limit.max), "") << element;
  for (const double value : {kNan, kInf, -kInf, 1e300, limit.max * 1.001 + 1e-9}) {
    EXPECT_EQ(said(value).find(element + std::string(" is ")), 0u) << element << " " << value << ": " << said(value);
    EXPECT_NE(said(value).find(limit.unit), std::string::npos) << said(value);
  }
}

TEST(MessageLimits, OfRectangles) {
  using Set = std::function<void(Rectangle&, double)>;
  const auto expect = [](const Set& set, const core::Limit& limit, const char* element) {
    expectLimit<Rectangle>(goodRectangle(), set, limit, element);
  };
  expect([](Rectangle& message, double value) { message.width = value; }, core::limits::kSide, "width");
  expect([](Rectangle& message, double value) { message.height = value; }, core::limits::kSide, "height");
  expect([](Rectangle& message, double value) { message.pose.covariance[7] = value; }, core::limits::kSensedVariance,
         "covariance");
  expect([](Rectangle& message, double value) { message.recall = value; }, core::limits::kQuality, "recall");
  for (const double none : {0.0, -0.4})
    EXPECT_NE(refusal<Rectangle>(goodRectangle(), [&](Rectangle& message) { message.width = none; }), "");
  EXPECT_EQ(refusal<Rectangle>(goodRectangle(), [](Rectangle& message) { message.pose.pose.position.x = 1e38; }),
            "position is (1e+38, 0, 1.5), expected -1e+08 to 1e+08 m");
  EXPECT_EQ(refusal<Rectangle>(goodRectangle(), [](Rectangle& message) { message.pose.pose.position.x = 5e6; }), "")
      << "in a map of UTM";
  EXPECT_EQ(refusal<Rectangle>(goodRectangle(), [](Rectangle& message) { message.pose.pose.position.x = 2e7; }),
            "position is (2e+07, 0, 1.5), expected -1e+07 to 1e+07 m");
  EXPECT_EQ(refusal<Rectangle>(goodRectangle(), [](Rectangle& message) { message.height = 0.0005; }),
            "height is 0.0005, expected 0.001 to 10 m");
  EXPECT_EQ(refusal<Rectangle>(goodRectangle(), [](Rectangle& message) { message.edge_support[2] = -1; }),
            "edge_support is -1, expected 0 to 1 (a share)");
  EXPECT_EQ(refusal<Rectangle>(goodRectangle(), [](Rectangle& message) { message.plane = 4294967295U; }).find("plane is "), 0u);
}

TEST(MessageLimits, OfTracks) {
  using Set = std::function<void(Track&, double)>;
  const auto expect = [](const Set& set, const core::Limit& limit, const char* element) {
    expectLimit<Track>(goodTrack(), set, limit, element);
  };
  expect([](Track& message, double value) { message.width = value; }, core::limits::kSide, "width");
  expect([](Track& message, double value) { message.heights = {value}; }, core::limits::kSide, "heights");
  expect([](Track& message, double value) { message.measured_widths = {value}; }, core::limits::kSide, "measured_widths");
  expect([](Track& message, double value) { message.covariances[35] = value; }, core::limits::kVariance, "covariances");
  EXPECT_EQ(refusal<Track>(goodTrack(), [](Track& message) { message.width = message.height = 0; }), "") << "not known";
  EXPECT_EQ(refusal<Track>(goodTrack(), [](Track& message) { message.poses[0].position.x = 5e6; }), "") << "a map of UTM";
  EXPECT_EQ(refusal<Track>(goodTrack(), [](Track& message) { message.stamps[0] = ros::TIME_MAX; }),
            "stamps is 4294967295 s, expected 4290000000 s at most: time of ROS ends soon after");
}

TEST(MessageLimits, OfExpectedFronts) {
  ExpectedFront good;
  good.pose = somewhere();
  good.width = good.height = 0.4;
  using Set = std::function<void(ExpectedFront&, double)>;
  expectLimit<ExpectedFront>(good, Set([](auto& message, double value) { message.velocity.y = value; }), core::limits::kSpeed,
                             "length of velocity");
  expectLimit<ExpectedFront>(good, Set([](auto& message, double value) { message.angular_velocity.y = value; }),
                             core::limits::kTurnRate, "length of angular_velocity");
  ExpectedFrontArray array;
  expectLimit<ExpectedFrontArray>(
      array, std::function<void(ExpectedFrontArray&, double)>([](auto& message, double value) { message.horizon = value; }),
      core::limits::kHorizon, "horizon");
}

TEST(MessageLimits, OfNames) {
  const auto said = [](const std::string& name) {
    return refusal<ArticulationModel>(toMessage(core::LearnedModel(), "map"),
                                      [&](ArticulationModel& message) { message.name = name; });
  };
  EXPECT_EQ(said("fridge"), "");
  EXPECT_EQ(said("top drawer").find("the character at position 4 of the name"), 0u);
  EXPECT_EQ(said(std::string(1000000, 'x')).find("the name has 1000000 characters"), 0u);
}

TEST(MessageLimits, OfModels) {
  ArticulationModel good = toMessage(core::LearnedModel(), "map");
  using Set = std::function<void(ArticulationModel&, double)>;
  const auto expect = [&](const Set& set, const core::Limit& limit, const char* element) {
    expectLimit<ArticulationModel>(good, set, limit, element);
  };
  expect([](auto& message, double value) { message.q_max = value; }, core::limits::kConfiguration, "q_max");
  expect([](auto& message, double value) { message.radius = value; }, core::limits::kRadius, "radius");
  expect([](auto& message, double value) { message.axis_point.z = value; }, core::limits::kFromOrigin, "axis_point");
  expect([](auto& message, double value) { message.doubt = value; }, core::limits::kQuality, "doubt");
  expect([](auto& message, double value) { message.parent_probability = value; }, core::limits::kProbability,
         "parent_probability");
  EXPECT_EQ(refusal<ArticulationModel>(good, [](auto& message) { message.support = kNan; }).find("support is nan"), 0u);
  EXPECT_EQ(refusal<ArticulationModel>(good, [](auto& message) { message.axis.x = 1e38; }).find("length of axis is "), 0u);
}

TEST(MessageLimits, OfPlanes) {
  EXPECT_EQ(refusal<Plane>(goodPlane(), [](Plane&) {}), "");
  using Set = std::function<void(Plane&, double)>;
  expectLimit<Plane>(goodPlane(), Set([](auto& message, double value) { message.coefficients[3] = value; }),
                     core::limits::kPlaneOffset, "coefficients[3]");
  expectLimit<Plane>(goodPlane(), Set([](auto& message, double value) { message.disparity_plane[0] = value; }),
                     core::limits::kDisparityPlane, "disparity_plane");
  EXPECT_EQ(refusal<Plane>(goodPlane(), [](Plane& message) { message.coefficients[0] = 1e300; }).find("length of coeff"), 0u);
  EXPECT_EQ(refusal<Plane>(goodPlane(), [](Plane& message) { message.hull[0].x = 3e38F; }),
            "hull's x is 3e+38, expected -320 to 640 px, near the image");
  EXPECT_EQ(refusal<Plane>(goodPlane(), [](Plane& message) { message.hull[0].y = static_cast<float>(kNan); }),
            "hull's y is nan, expected -240 to 480 px, near the image");
  EXPECT_EQ(refusal<Plane>(goodPlane(), [](Plane& message) { message.hull.resize(80000); }),
            "number of hull's corners is 80000, expected 0 to 1120 for a mask of this size");
  EXPECT_EQ(refusal<Plane>(goodPlane(), [](Plane& message) { message.inliers = 4294967295U; }).find("inliers is "), 0u);
}

TEST(MessageLimits, OfCameras) {
  const auto said = [](int element, double value) {
    sensor_msgs::CameraInfo left = test::cameraInfo(test::smallCamera(), false),
                            right = test::cameraInfo(test::smallCamera(), true);
    left.P[element] = value;
    return errorOf([&] { toStereoCamera(left, right, "/left", "/right"); });
  };
  EXPECT_EQ(said(0, 300), "");
  EXPECT_EQ(said(0, 1e38), "/left: focal length fx (P[0]) is 1e+38, expected 1 to 100000 px");
  EXPECT_EQ(said(5, 1e-3), "/left: focal length fy (P[5]) is 0.001, expected 1 to 100000 px");
  EXPECT_EQ(said(2, -1e9), "/left: principal point cx (P[2]) is -1e+09, expected -100000 to 100000 px");
  sensor_msgs::CameraInfo left = test::cameraInfo(test::smallCamera(), false),
                          right = test::cameraInfo(test::smallCamera(), true);
  right.P[0] = 1e38;
  EXPECT_EQ(errorOf([&] { toStereoCamera(left, right, "/left", "/right"); }).find("/right: right camera's baseline"), 0u);
  left.width = 2147483648U;
  EXPECT_NE(errorOf([&] { toDepthCamera(left, "/depth", 0.1); }), "");
  left.width = 65536;
  EXPECT_EQ(errorOf([&] { toDepthCamera(left, "/depth", 0.1); }), "/depth: width is 65536, expected 1 to 16384 px");
}

TEST(MessageLimits, OfStamps) {
  EXPECT_EQ(errorOf([] { requireStamp("stamp", ros::Time(core::limits::kLastSecond)); }), "");
  EXPECT_NE(errorOf([] { requireStamp("stamp", ros::Time(core::limits::kLastSecond + 1)); }), "");
}

}  // namespace
}  // namespace cabinet_articulation
