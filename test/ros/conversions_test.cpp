// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/conversions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "support/ros_messages.h"

namespace cabinet_articulation {
namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Isometry3d examplePose(double angle = 2.4) {
  return Eigen::Translation3d(0.1, -0.2, 1.5) * Eigen::AngleAxisd(angle, Eigen::Vector3d(1, 0.2, 0.1).normalized());
}

/// Every element differs, so that swapped rows and columns show.
core::Matrix6d exampleCovariance(double start = 0) {
  core::Matrix6d covariance;
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) covariance(row, column) = start + 10 * row + column;
  return covariance;
}

std_msgs::Header exampleHeader() {
  std_msgs::Header header;
  header.frame_id = "map";
  header.stamp = ros::Time(1700000000, 123456789);
  return header;
}

core::DetectedRectangle exampleRectangle() {
  core::DetectedRectangle rectangle;
  rectangle.rectangle = {examplePose(), 0.4, 0.6};
  rectangle.covariance = exampleCovariance();
  rectangle.precision = 0.91;
  rectangle.recall = 0.73;
  rectangle.edge_support = {1, 0.5, 0, 0.25};
  rectangle.region = 3;
  rectangle.hollow = true;
  return rectangle;
}

core::Track exampleTrack() {
  core::Track track;
  track.id = 7;
  track.width = 0.41;
  track.height = 0.61;
  track.hollow = true;
  for (int i = 0; i < 3; ++i) {
    core::TrackedObservation observation;
    observation.stamp = 100.25 + i;
    observation.rectangle = {examplePose(0.1 * i), 0.4 + 0.01 * i, 0.6 - 0.01 * i};
    observation.covariance = exampleCovariance(i);
    observation.edge_support = {1, 0, 0.5F * static_cast<float>(i), 0.125};
    observation.measured = {examplePose(0.3 * i), 0.3 + 0.01 * i, 0.5 - 0.01 * i};
    observation.measured_covariance = exampleCovariance(i + 1);
    track.observations.push_back(observation);
  }
  return track;
}

core::LearnedModel exampleModel() {
  core::LearnedModel model;
  model.id = 9;
  model.stamp = 12.5;
  model.type = core::JointType::kRotational;
  model.probabilities = {0.01, 0.02, 0.97};
  model.moved = true;
  model.explained = false;
  model.name = "oven";
  model.observed = false;
  model.hollow = model.closed_known = true;
  model.support = 12;
  model.doubt = 0.3;
  model.parent = 4;
  model.parent_probability = 0.7;
  model.pitch = 0.01;
  model.q_closed = -0.2;
  model.opening = 0.8;
  model.origin = examplePose();
  model.axis = Eigen::Vector3d(0, -0.6, 0.8);
  model.axis_point = Eigen::Vector3d(1, 2, 3);
  model.radius = 0.37;
  model.q = 0.5;
  model.q_min = -0.1;
  model.q_max = 1.5;
  model.q_max_is_end = true;
  model.curve = {examplePose(), examplePose(1)};
  model.width = 0.4;
  model.height = 0.6;
  model.covariance = exampleCovariance();
  model.position_error = 0.004;
  model.orientation_error = 0.02;
  model.observations = 57;
  model.params = {{"rot_radius", 0.37, core::ModelParam::kParam}, {"bic", -12, core::ModelParam::kEval}};
  return model;
}

TEST(PoseConversion, GivesBackTheSamePose) {
  for (const double angle : {0.0, 1.0, M_PI, 4.0}) {
    const Eigen::Isometry3d pose = examplePose(angle);
    EXPECT_TRUE(fromMessage(toMessage(pose)).isApprox(pose, 1e-12)) << angle;
  }
}

TEST(PoseConversion, PublishesUnitQuaternionsOfSlightlyDriftedRotations) {
  Eigen::Isometry3d drifted = examplePose();
  drifted.linear() *= 1 + 1e-6;
  const geometry_msgs::Quaternion q = toMessage(drifted).orientation;
  EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-14);
}

TEST(PoseConversion, RefusesWhatIsNoPose) {
  geometry_msgs::Pose message = toMessage(examplePose());
  message.position.y = kNan;
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }), "position is (0.1, nan, 1.5), expected -1e+08 to 1e+08 m");
  EXPECT_EQ(test::errorOf([] { fromMessage(geometry_msgs::Pose()); }), "orientation has length 0, expected a unit quaternion");
  message = toMessage(examplePose());
  message.orientation.w = kNan;
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }), "orientation has length nan, expected a unit quaternion");
}

TEST(RectangleConversion, KeepsEveryField) {
  const core::DetectedRectangle rectangle = exampleRectangle();
  const Rectangle message = toMessage(rectangle);
  EXPECT_EQ(message.pose.covariance[6 * 1 + 2], 12) << "row-major";
  EXPECT_EQ(message.plane, 3u);
  const core::DetectedRectangle back = fromMessage(message);
  EXPECT_TRUE(back.rectangle.pose.isApprox(rectangle.rectangle.pose, 1e-12));
  EXPECT_EQ(back.rectangle.width, rectangle.rectangle.width);
  EXPECT_EQ(back.rectangle.height, rectangle.rectangle.height);
  EXPECT_EQ(back.covariance, rectangle.covariance);
  EXPECT_EQ(back.precision, rectangle.precision);
  EXPECT_EQ(back.recall, rectangle.recall);
  EXPECT_EQ(back.edge_support, rectangle.edge_support);
  EXPECT_EQ(back.region, rectangle.region);
  EXPECT_EQ(back.hollow, rectangle.hollow);
}

TEST(RectangleConversion, ArrayCarriesTheHeaderAndNamesTheBadElement) {
  RectangleArray message = toMessage({exampleRectangle(), exampleRectangle()}, exampleHeader());
  EXPECT_EQ(message.header.stamp, exampleHeader().stamp);
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(fromMessage(message).size(), 2u);
  message.rectangles[1].pose.pose.orientation.w = 5;
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }).find("rectangles[1]: orientation has length"), 0u);
  EXPECT_TRUE(fromMessage(toMessage(std::vector<core::DetectedRectangle>(), exampleHeader())).empty());
}

TEST(TrackConversion, KeepsEveryObservation) {
  const core::Track track = exampleTrack();
  const Track message = toMessage(track, "map");
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(102, 250000000));
  const core::Track back = wholeTrack(message);
  EXPECT_EQ(back.id, track.id);
  EXPECT_EQ(back.width, track.width);
  EXPECT_EQ(back.height, track.height);
  EXPECT_EQ(back.hollow, track.hollow);
  ASSERT_EQ(back.observations.size(), track.observations.size());
  for (size_t i = 0; i < track.observations.size(); ++i) {
    EXPECT_EQ(back.observations[i].stamp, track.observations[i].stamp);
    EXPECT_TRUE(back.observations[i].rectangle.pose.isApprox(track.observations[i].rectangle.pose, 1e-12));
    EXPECT_EQ(back.observations[i].rectangle.width, track.observations[i].rectangle.width);
    EXPECT_EQ(back.observations[i].rectangle.height, track.observations[i].rectangle.height);
    EXPECT_EQ(back.observations[i].covariance, track.observations[i].covariance);
    EXPECT_TRUE(back.observations[i].measured.pose.isApprox(track.observations[i].measured.pose, 1e-12));
    EXPECT_EQ(back.observations[i].measured.width, track.observations[i].measured.width);
    EXPECT_EQ(back.observations[i].measured.height, track.observations[i].measured.height);
    EXPECT_EQ(back.observations[i].measured_covariance, track.observations[i].measured_covariance);
    EXPECT_EQ(back.observations[i].edge_support, track.observations[i].edge_support);
  }
}

TEST(TrackConversion, OptionalListsMayBeMissing) {
  Track message = toMessage(exampleTrack(), "map");
  message.widths.clear();
  message.heights.clear();
  message.covariances.clear();
  message.edge_support.clear();
  for (std::vector<double>* list : {&message.measured_widths, &message.measured_heights, &message.measured_covariances})
    list->clear();
  message.measured_poses.clear();
  const core::Track track = wholeTrack(message);
  EXPECT_EQ(track.observations[2].rectangle.width, message.width);
  EXPECT_EQ(track.observations[2].covariance, core::Matrix6d::Zero());
  EXPECT_EQ(track.observations[2].measured.width, message.width);
  EXPECT_EQ(track.observations[2].measured.pose.matrix(), track.observations[2].rectangle.pose.matrix());
  EXPECT_EQ(track.observations[2].edge_support, (std::array<float, 4>{1, 1, 1, 1}));
}

TEST(TrackConversion, RefusesListsOfDifferentLengthAndNamesThem) {
  TrackArray message = toMessage({exampleTrack()}, exampleHeader());
  message.tracks[0].covariances.pop_back();
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }), "tracks[0]: covariances has 107 elements, expected 108 for 3 poses");
  message = toMessage({exampleTrack()}, exampleHeader());
  message.tracks[0].stamps.clear();
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }), "tracks[0]: stamps has 0 elements, expected 3 for 3 poses");
  message = toMessage({exampleTrack()}, exampleHeader());
  message.tracks[0].poses[1].position.z = kNan;
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }).find("tracks[0]: poses[1]: position is"), 0u);
}

TEST(TrackConversion, RefusesWhatNoTrackerSends) {
  core::Track track = exampleTrack();
  const auto errorOf = [&](const std::vector<core::Track>& tracks) {
    return test::errorOf([&] { fromMessage(toMessage(tracks, exampleHeader())); });
  };
  EXPECT_EQ(errorOf({track}), "");
  EXPECT_EQ(errorOf({track, track}), "tracks[1]: id 7 is there twice");
  track.id = 0;
  EXPECT_EQ(errorOf({track}), "tracks[0]: id is 0, expected 1 or more");
  track = exampleTrack();
  track.height = kNan;
  EXPECT_EQ(errorOf({track}), "tracks[0]: height is nan, expected 0.001 to 10 m, or 0: not known");
  track = exampleTrack();
  track.observations.clear();
  EXPECT_EQ(errorOf({track}), "tracks[0]: no poses, expected at least the newest one");
}

TEST(TrackConversion, APartIsNoWholeTrack) {
  const Track message = toMessage(core::TrackUpdate{exampleTrack(), 12}, "map");
  EXPECT_EQ(message.first, 12u);
  EXPECT_EQ(fromMessage(message).first, 12u);
  EXPECT_EQ(test::errorOf([&] { wholeTrack(message); }), "first is 12, expected 0: a whole track");
}

TEST(ExpectedFrontConversion, RefusesWhatIsNotFinite) {
  core::ExpectedFronts expected;
  expected.fronts.resize(2);
  ExpectedFrontArray message = toMessage(expected, exampleHeader());
  EXPECT_EQ(fromMessage(message).fronts.size(), 2u);
  message.fronts[1].velocity.y = kNan;
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }), "fronts[1]: length of velocity is nan, expected 0 to 100 m/s");
  message.horizon = kNan;
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }), "horizon is nan, expected 0 to 10 s");
}

TEST(TrackConversion, EmptyTrackHasNoStamp) {
  const Track message = toMessage(core::Track(), "map");
  EXPECT_TRUE(message.header.stamp.isZero());
  EXPECT_TRUE(wholeTrack(message).observations.empty());
}

TEST(ModelConversion, KeepsEveryField) {
  const core::LearnedModel model = exampleModel();
  const ArticulationModelArray array = toMessage({model}, exampleHeader());
  ASSERT_EQ(array.models.size(), 1u);
  const ArticulationModel& message = array.models[0];
  EXPECT_EQ(message.header.frame_id, "map");
  EXPECT_EQ(message.header.stamp, ros::Time(12, 500000000)) << "the newest observation's, not the frame's";
  EXPECT_EQ(message.type, ArticulationModel::ROTATIONAL);
  EXPECT_EQ(message.params[1].name, "bic");
  EXPECT_EQ(message.params[1].type, Param::EVAL);
  const core::LearnedModel back = fromMessage(array).at(0);
  EXPECT_EQ(back.id, model.id);
  EXPECT_EQ(back.stamp, model.stamp);
  EXPECT_EQ(back.type, model.type);
  EXPECT_EQ(back.probabilities, model.probabilities);
  EXPECT_EQ(back.moved, model.moved);
  EXPECT_FALSE(back.q_min_is_end);
  EXPECT_TRUE(back.q_max_is_end);
  ASSERT_EQ(back.curve.size(), 2u);
  EXPECT_TRUE(back.curve[1].isApprox(model.curve[1], 1e-12));
  EXPECT_EQ(back.explained, model.explained);
  EXPECT_EQ(back.name, model.name);
  EXPECT_EQ(back.parent, model.parent);
  EXPECT_EQ(back.observed, model.observed);
  EXPECT_EQ(back.hollow, model.hollow);
  EXPECT_EQ(back.closed_known, model.closed_known);
  EXPECT_TRUE(back.origin.isApprox(model.origin, 1e-12));
  EXPECT_EQ(back.axis, model.axis);
  EXPECT_EQ(back.axis_point, model.axis_point);
  EXPECT_EQ(back.covariance, model.covariance);
  for (const auto& field : {&core::LearnedModel::radius, &core::LearnedModel::q, &core::LearnedModel::q_min,
                            &core::LearnedModel::q_max, &core::LearnedModel::width, &core::LearnedModel::height,
                            &core::LearnedModel::position_error, &core::LearnedModel::orientation_error,
                            &core::LearnedModel::support, &core::LearnedModel::doubt, &core::LearnedModel::parent_probability,
                            &core::LearnedModel::pitch, &core::LearnedModel::q_closed, &core::LearnedModel::opening})
    EXPECT_EQ(back.*field, model.*field);
  EXPECT_EQ(back.observations, model.observations);
  ASSERT_EQ(back.params.size(), 2u);
  EXPECT_EQ(back.params[0].name, "rot_radius");
  EXPECT_EQ(back.params[0].value, 0.37);
  EXPECT_EQ(back.params[0].kind, core::ModelParam::kParam);
}

TEST(ModelConversion, SaysUnknownOfWhatNobodyFillsYet) {
  const ArticulationModel message = toMessage(core::LearnedModel(), "map");
  EXPECT_EQ(message.name, "");
  EXPECT_EQ(message.parent, 0u);
  EXPECT_EQ(message.parent_probability, 1);
  EXPECT_TRUE(std::isnan(message.q_closed));
  EXPECT_FALSE(message.closed_known);
  EXPECT_TRUE(std::isnan(message.opening));
  EXPECT_TRUE(message.observed);
  EXPECT_FALSE(message.hollow);
  EXPECT_EQ(message.pitch, 0);
}

TEST(ModelConversion, RefusesAnUnknownType) {
  ArticulationModel message = toMessage(exampleModel(), "map");
  message.type = 17;
  EXPECT_EQ(test::errorOf([&] { fromMessage(message); }), "type is 17, expected less than 5");
}

TEST(StampConversion, NeverThrows) {
  for (const double before : {-1.0, -1e300, std::nan("")}) EXPECT_EQ(toStamp(before), ros::Time(0));
  for (const double after : {4294967296.0, 1e300}) EXPECT_EQ(toStamp(after), ros::TIME_MAX);
  EXPECT_EQ(toStamp(ros::TIME_MAX.toSec()), ros::TIME_MAX);
}

TEST(StampConversion, DifferencesMayBeLongerThanADuration) {
  EXPECT_NEAR(secondsBetween(ros::Time(0), ros::TIME_MAX), 4294967296.0, 1e-6);
  EXPECT_EQ(secondsBetween(ros::Time(1795000000, 2), ros::Time(1795000000, 1)), -1e-9);
}

TEST(StampConversion, KeepsNanosecondsOfShortTimesAndAFractionOfAMicrosecondOfTodays) {
  EXPECT_EQ(toStamp(ros::Time(1000, 66666667).toSec()), ros::Time(1000, 66666667));
  EXPECT_NEAR((toStamp(exampleHeader().stamp.toSec()) - exampleHeader().stamp).toSec(), 0, 2.4e-7);
}

}  // namespace
}  // namespace cabinet_articulation
