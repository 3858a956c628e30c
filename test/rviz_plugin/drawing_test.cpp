// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/drawing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "cabinet_articulation/joints/joint.h"
#include "rviz_plugin/front_drawing.h"
#include "rviz_plugin/joint_drawing.h"
#include "support/models.h"

namespace cabinet_articulation {
namespace {

double length(const std::vector<DrawnLine>& lines) {
  double sum = 0;
  for (const DrawnLine& line : lines) sum += (line.to - line.from).norm();
  return sum;
}

core::Track openingDoor(int observations) {
  const core::LearnedModel door = test::doorModel();
  core::Track track;
  track.id = door.id;
  for (int i = 0; i < observations; ++i) {
    core::TrackedObservation seen;
    seen.stamp = i;
    seen.rectangle = core::frontAt(door, door.q_max * i / (observations - 1));
    track.observations.push_back(seen);
  }
  return track;
}

TEST(FrontDrawing, AsMuchOfAnEdgeIsDrawnAsWasObserved) {
  core::DetectedRectangle seen;
  seen.rectangle = {test::facingCamera(0, 0, 1), 0.4, 0.6};
  seen.edge_support = {{1, 0.25F, 0, 0.5F}};
  Drawing drawing;
  drawRectangles({seen}, ColorBy::kType, &drawing);
  EXPECT_NEAR(length(drawing.lines), 0.6 + 0.25 * 0.6 + 0.5 * 0.4, 1e-9);
  // The edge at -x is unbroken.
  EXPECT_NEAR((drawing.lines[0].to - drawing.lines[0].from).norm(), 0.6, 1e-9);
  EXPECT_NEAR((seen.rectangle.pose.inverse() * drawing.lines[0].from).x(), -0.2, 1e-9);
}

TEST(FrontDrawing, SamplesFollowTheWay) {
  const core::Track track = openingDoor(200);
  EXPECT_EQ(sampledObservations(track, 0).size(), 200u);
  // The centre's way is 0.2 m * 1.2 rad = 0.24 m: 50 poses a metre are 12, the first and the newest among them.
  const auto sampled = sampledObservations(track, 50);
  EXPECT_NEAR(static_cast<double>(sampled.size()), 12, 2);
  EXPECT_EQ(sampled.front(), 0u);
  EXPECT_EQ(sampled.back(), 199u);
  Drawing drawing;
  TrackStyle style;
  style.latest_only = true;
  drawTrack(track, nullptr, style, &drawing);
  EXPECT_EQ(drawing.lines.size(), 4u) << "one rectangle";
  drawTrack(core::Track(), nullptr, style, &drawing);
  EXPECT_EQ(drawing.lines.size(), 4u) << "nothing of a track without observations";
}

TEST(FrontDrawing, ObservationsInTheirStyles) {
  const core::Track track = openingDoor(2);
  const auto drawn = [&](ObservationStyle observations) {
    TrackStyle style;
    style.observations = observations;
    style.latest_only = true;
    Drawing drawing;
    drawTrack(track, nullptr, style, &drawing);
    return drawing.lines;
  };
  const core::Rectangle& front = track.observations.back().rectangle;
  const auto cross = drawn(ObservationStyle::kCross), axes = drawn(ObservationStyle::kAxes);
  ASSERT_EQ(cross.size(), 2u);
  EXPECT_NEAR(length(cross), front.width + front.height, 1e-9);
  EXPECT_TRUE((cross[0].from + cross[0].to).isApprox(2 * front.center(), 1e-9));
  ASSERT_EQ(axes.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = axes[k].to - axes[k].from;
    EXPECT_TRUE(axis.normalized().isApprox(front.pose.linear().col(k), 1e-9)) << k;
    EXPECT_EQ(axes[k].paint.color[k], 1) << k;
  }
  EXPECT_TRUE(drawn(ObservationStyle::kLine).empty());
}

TEST(FrontDrawing, ProjectedObservationsLieOnTheModel) {
  core::Track track = openingDoor(20);
  for (core::TrackedObservation& seen : track.observations) seen.rectangle.pose.translation() += Eigen::Vector3d(0, 0.02, 0);
  const core::LearnedModel door = test::doorModel();
  TrackStyle style;
  style.projected = true;
  Drawing projected, observed;
  drawTrack(track, &door, style, &projected);
  style.projected = false;
  drawTrack(track, &door, style, &observed);
  EXPECT_NEAR(projected.texts[0].at.y(), 0, 1e-9);
  EXPECT_NEAR(observed.texts[0].at.y(), 0.02, 1e-9);
}

TEST(DisplayColors, FrontsThatFollowOneAnotherDiffer) {
  for (std::uint32_t id = 1; id < 20; ++id) EXPECT_NE(colorOfId(id), colorOfId(id + 1)) << id;
  EXPECT_EQ(colorOfShare(0), core::palette::kBlue);
  EXPECT_EQ(colorOfShare(1), core::palette::kYellow);
  EXPECT_EQ(colorOfShare(std::nan("")), core::palette::kBlue);
  const core::LearnedModel door = test::doorModel();
  EXPECT_EQ(colorOf(door, ColorBy::kType, 0), colorOf(door)) << "as overlay and markers";
  EXPECT_EQ(colorOf(door, ColorBy::kTime, 1e9), core::palette::kBlue) << "long ago";
}

TEST(JointDrawing, SurfaceGhostsAndAxisAreWhereTheModelSays) {
  const core::LearnedModel door = test::doorModel();
  JointStyle style;
  style.ghosts = 5;
  Drawing drawing;
  drawJoints({door}, {}, style, &drawing);
  const auto now = core::frontAt(door, door.q).corners();
  EXPECT_TRUE(drawing.triangles[0].corners[0].isApprox(now[0], 1e-12));
  EXPECT_TRUE(drawing.triangles[1].corners[2].isApprox(now[3], 1e-12));
  ASSERT_GE(drawing.lines.size(), 24u);
  const auto widest = core::frontAt(door, door.q_max).corners();
  EXPECT_TRUE(drawing.lines[20].from.isApprox(widest[0], 1e-12)) << "the last ghost";
  const DrawnLine& axis = drawing.lines.back();
  EXPECT_TRUE(axis.from.isApprox(Eigen::Vector3d(-0.1, -0.3, 1.2), 1e-9));
  EXPECT_TRUE(axis.to.isApprox(Eigen::Vector3d(-0.1, 0.3, 1.2), 1e-9));
  ASSERT_EQ(drawing.texts.size(), 1u);
  EXPECT_EQ(drawing.texts[0].text, "3 rotational 97 %\n29 deg (0 to 69)");
}

TEST(JointDrawing, GhostsAtObservations) {
  JointStyle style;
  style.at_observations = true;
  style.axis = style.label = false;
  style.ghosts = 4;
  Drawing with, without;
  drawJoints({test::doorModel()}, {openingDoor(8)}, style, &with);
  drawJoints({test::doorModel()}, {}, style, &without);
  EXPECT_EQ(with.lines.size() - without.lines.size(), 16u) << "four ghosts of four edges";
}

TEST(JointDrawing, NeverMoreGhostsThanAskedFor) {
  JointStyle style;
  style.axis = style.label = false;
  const auto ghosts = [&](int asked, int observations) {
    style.ghosts = asked;
    // The front's outline and the way of 16 steps are lines, too.
    Drawing drawing;
    drawJoints({test::doorModel()}, {openingDoor(observations)}, style, &drawing);
    return (static_cast<int>(drawing.lines.size()) - 4 - 16) / 4;
  };
  for (const int asked : {1, 2, 6}) EXPECT_EQ(ghosts(asked, 11), asked) << "over the range";
  style.at_observations = true;
  EXPECT_EQ(ghosts(1, 11), 1);
  EXPECT_EQ(ghosts(6, 11), 6);
  EXPECT_EQ(ghosts(6, 13), 5);
  EXPECT_EQ(ghosts(6, 3), 3);
}

TEST(JointDrawing, WhatHangsOnADoorIsDrawnWhereTheDoorIs) {
  const core::LearnedModel door = test::doorModel(), leaf = test::leafModel();
  const Eigen::Isometry3d at_edge(Eigen::Translation3d(0.2, 0, 0)), fold(Eigen::AngleAxisd(leaf.q, Eigen::Vector3d::UnitY()));
  const core::Rectangle truth{door.predict(door.q) * at_edge * fold * at_edge, leaf.width, leaf.height};
  JointStyle style;
  style.axis = style.label = false;
  style.at_observations = true;
  core::Track seen = openingDoor(8);
  seen.id = leaf.id;
  Drawing drawing;
  drawJoints({door, leaf}, {seen}, style, &drawing);
  ASSERT_EQ(drawing.triangles.size(), 4u) << "two surfaces";
  EXPECT_TRUE(drawing.triangles[2].corners[0].isApprox(truth.corners()[0], 1e-9));
  EXPECT_EQ(drawing.lines.size(), 2 * (4 + 16u)) << "observations are in another frame than its model: no ghosts at them";
  Drawing alone;
  drawJoints({leaf}, {}, style, &alone);
  EXPECT_TRUE(alone.triangles.empty()) << "nobody knows where it is";
}

TEST(FrontDrawing, ObservationsOfWhatHangsOnADoorAreNotProjected) {
  core::Track track = openingDoor(20);
  const core::LearnedModel leaf = test::leafModel();
  TrackStyle style;
  style.projected = true;
  Drawing drawing;
  drawTrack(track, &leaf, style, &drawing);
  EXPECT_TRUE(drawing.texts[0].at.isApprox(track.observations.back().rectangle.center(), 1e-12));
}

TEST(JointDrawing, OneOfEachTypeIsTheOneSeenLast) {
  core::LearnedModel now = test::doorModel(), before = now, doubted = now;
  before.id = 20, before.stamp = now.stamp - 1;
  doubted.id = 21;
  for (double& probability : doubted.probabilities) probability /= 2;
  JointStyle style;
  style.one_of_each_type = true;
  Drawing drawing;
  drawJoints({before, doubted, now, test::drawerModel()}, {}, style, &drawing);
  std::set<std::string> labels;
  for (const DrawnText& text : drawing.texts) labels.insert(text.text.substr(0, text.text.find(' ')));
  EXPECT_EQ(labels, (std::set<std::string>{std::to_string(now.id), std::to_string(test::drawerModel().id)}));
}

TEST(JointDrawing, RestingFrontsCanBeLeftOut) {
  JointStyle style;
  style.resting = false;
  Drawing drawing;
  drawJoints({test::restingModel(), test::unexplainedModel()}, {}, style, &drawing);
  EXPECT_TRUE(drawing.lines.empty() && drawing.triangles.empty() && drawing.texts.empty());
}

/// The axis is displaced and turned by errors of the model's covariance: 95 % of them must pass through each ring.
TEST(AxisUncertainty, HoldsTheAxisWithNinetyFivePercent) {
  core::LearnedModel door = test::doorModel();
  Eigen::Matrix<double, 6, 1> deviations;
  deviations << 0.004, 0.02, 0.001, 0.02, 0.1, 0.005;
  door.covariance = deviations.cwiseAbs2().asDiagonal();
  door.covariance(0, 5) = door.covariance(5, 0) = 0.7 * deviations(0) * deviations(5);
  const Eigen::Matrix<double, 6, 6> root = door.covariance.llt().matrixL();
  const auto rings = axisUncertainty(door);
  ASSERT_EQ(rings.size(), 9u);
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  constexpr int kSamples = 20000;
  for (const TubeRing& ring : rings) {
    Eigen::Matrix<double, 3, 2> half_axes;
    half_axes << ring.half_axis_a, ring.half_axis_b;
    int inside = 0;
    for (int i = 0; i < kSamples; ++i) {
      Eigen::Matrix<double, 6, 1> error;
      for (int k = 0; k < 6; ++k) error(k) = gauss(random);
      error = root * error;
      // Where the true axis pierces the plane of the ring.
      const Eigen::Vector3d point = door.axis_point + error.head<3>();
      const Eigen::Vector3d direction = Eigen::AngleAxisd(error.tail<3>().norm(), error.tail<3>().normalized()) * door.axis;
      const double s = door.axis.dot(ring.center - point) / door.axis.dot(direction);
      const Eigen::Vector2d on_ring = half_axes.colPivHouseholderQr().solve(point + s * direction - ring.center);
      if (on_ring.norm() <= 1) ++inside;
    }
    // Within three standard deviations of the share, and what linearisation leaves out.
    EXPECT_NEAR(static_cast<double>(inside) / kSamples, 0.95, 0.01);
  }
}

TEST(AxisUncertainty, NothingWhereNothingIsKnown) {
  EXPECT_TRUE(axisUncertainty(test::doorModel()).empty()) << "no covariance given";
  core::LearnedModel broken = test::doorModel();
  broken.covariance(0, 0) = std::nan("");
  EXPECT_TRUE(axisUncertainty(broken).empty());
  core::LearnedModel garage = test::garageModel();
  garage.covariance.setIdentity();
  EXPECT_TRUE(axisUncertainty(garage).empty()) << "a free motion has no axis";
}

TEST(GraspPoint, IsAtTheEdgeFarFromTheHinge) {
  const core::LearnedModel door = test::doorModel();
  EXPECT_TRUE((door.origin * graspPoint(door)).isApprox(Eigen::Vector3d(0.3, 0, 1.2), 1e-9));
  EXPECT_TRUE(graspPoint(test::drawerModel()).isZero());
}

}  // namespace
}  // namespace cabinet_articulation
