// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/markers.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "ros/drawing/model_drawing.h"
#include "support/models.h"

namespace cabinet_articulation {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

std_msgs::Header mapHeader() {
  std_msgs::Header header;
  header.frame_id = "map";
  header.stamp = ros::Time(5);
  return header;
}

MarkerArray markersOf(const std::vector<core::LearnedModel>& models) {
  MarkerArray markers;
  addMarkers(models, mapHeader(), &markers);
  return markers;
}

const Marker* find(const MarkerArray& markers, const std::string& ns, int id) {
  for (const Marker& marker : markers.markers)
    if (marker.ns == ns && marker.id == id) return &marker;
  return nullptr;
}

TEST(Markers, DoorHasAFrontAnAxisASweepAndALabel) {
  const core::LearnedModel door = test::doorModel();
  const MarkerArray markers = markersOf({door});
  const Marker* front = find(markers, "fronts", 3);
  ASSERT_TRUE(front);
  const core::Rectangle now{door.predict(door.q), door.width, door.height};
  EXPECT_TRUE(fromMessage(front->points[0]).isApprox(now.corners()[0], 1e-12)) << "at the opening now";
  const Marker* axis = find(markers, "axes", 3);
  ASSERT_TRUE(axis);
  EXPECT_TRUE(fromMessage(axis->points[0]).isApprox(Eigen::Vector3d(-0.1, -0.3, 1.2), 1e-9)) << "as long as the door";
  EXPECT_TRUE(fromMessage(axis->points[1]).isApprox(Eigen::Vector3d(-0.1, 0.3, 1.2), 1e-9));
  const Marker* sweep = find(markers, "sweep", 3);
  ASSERT_TRUE(sweep);
  const core::Rectangle widest{door.predict(door.q_max), door.width, door.height};
  EXPECT_TRUE(fromMessage(sweep->points[sweep->points.size() - 8]).isApprox(widest.corners()[0], 1e-12))
      << "to the end of the range";
  const Marker* label = find(markers, "labels", 3);
  ASSERT_TRUE(label);
  EXPECT_EQ(label->text, "3 rotational 97 %, 29 deg (0 to 69)");
  core::LearnedModel named = door;
  named.name = "fridge";
  EXPECT_EQ(find(markersOf({named}), "labels", 3)->text, "3 fridge rotational 97 %, 29 deg (0 to 69)");
}

TEST(Markers, AxisOfADrawerIsItsWay) {
  const Marker axis = *find(markersOf({test::drawerModel()}), "axes", 4);
  EXPECT_TRUE(fromMessage(axis.points[0]).isApprox(Eigen::Vector3d(0.1, 0.3, 1.3), 1e-9));
  EXPECT_TRUE(fromMessage(axis.points[1]).isApprox(Eigen::Vector3d(0.1, 0.3, 1.0), 1e-9));
}

TEST(Markers, WayOfACurveIsDrawnAlongIt) {
  const core::LearnedModel garage = test::garageModel();
  const MarkerArray markers = markersOf({garage});
  const Marker* way = find(markers, "ways", 6);
  ASSERT_TRUE(way);
  EXPECT_TRUE(fromMessage(way->points.front()).isApprox(garage.curve.front().translation(), 1e-9));
  EXPECT_TRUE(fromMessage(way->points.back()).isApprox(garage.curve.back().translation(), 1e-9));
  EXPECT_TRUE(fromMessage(way->points[way->points.size() / 2]).isApprox(garage.predict(0.2).translation(), 1e-9));
  EXPECT_EQ(find(markers, "labels", 6)->text, "6 nonparametric 98 %, 20 cm (0 to 40)");
}

TEST(Markers, HaveTheColoursOfTheOverlay) {
  const auto colorOfMarker = [](const Marker& marker) { return Color{marker.color.r, marker.color.g, marker.color.b}; };
  for (const core::LearnedModel& model : {test::doorModel(), test::drawerModel(), test::garageModel()}) {
    const MarkerArray markers = markersOf({model});
    const int id = static_cast<int>(model.id);
    for (const char* ns : {"fronts", "ways", "sweep", "labels"})
      EXPECT_EQ(colorOfMarker(*find(markers, ns, id)), colorOf(model)) << ns;
    EXPECT_EQ(colorOfMarker(*find(markers, "axes", id)), kAxisColor);
  }
  MarkerArray rectangles;
  addMarkers({core::DetectedRectangle()}, mapHeader(), &rectangles);
  EXPECT_EQ(colorOfMarker(rectangles.markers.at(0)), kRectangleColor);
}

TEST(Markers, WhatIsNoJointHasOnlyAFront) {
  for (const core::LearnedModel& model : {test::restingModel(), test::unexplainedModel()})
    EXPECT_EQ(markersOf({model}).markers.size(), 1u);
}

TEST(Markers, AreValidForRViz) {
  MarkerArray markers = markersOf({test::doorModel(), test::drawerModel(), test::garageModel(), test::restingModel()});
  core::DetectedRectangle rectangle;
  rectangle.rectangle = {test::facingCamera(0, 0, 1), 0.4, 0.2};
  addMarkers({rectangle}, mapHeader(), &markers);
  MarkerHistory history;
  history.deleteVanished(&markers);
  markers.markers.resize(2);
  history.deleteVanished(&markers);
  for (const Marker& marker : markers.markers) {
    const auto& q = marker.pose.orientation;
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-9) << marker.ns;
    if (marker.action == Marker::DELETE) continue;
    EXPECT_EQ(marker.header.frame_id, "map");
    EXPECT_GT(marker.color.a, 0) << marker.ns;
    EXPECT_GT(std::max({marker.scale.x, marker.scale.y, marker.scale.z}), 0) << marker.ns;
    if (marker.type == Marker::LINE_LIST) {
      EXPECT_EQ(marker.points.size() % 2, 0u) << marker.ns;
    }
  }
}

TEST(MarkerHistory, DeletesWhatVanishedOnceAndLeavesTheRest) {
  MarkerHistory history;
  MarkerArray first = markersOf({test::doorModel(), test::restingModel()});
  const size_t shown = first.markers.size();
  history.deleteVanished(&first);
  EXPECT_EQ(first.markers.size(), shown) << "nothing to delete at first";
  MarkerArray second = markersOf({test::restingModel()});
  history.deleteVanished(&second);
  ASSERT_EQ(second.markers.size(), 1u + 5u);
  for (size_t i = 1; i < second.markers.size(); ++i) {
    EXPECT_EQ(second.markers[i].action, Marker::DELETE);
    EXPECT_EQ(second.markers[i].id, 3);
  }
  MarkerArray third = markersOf({test::restingModel()});
  history.deleteVanished(&third);
  EXPECT_EQ(third.markers.size(), 1u);
}

}  // namespace
}  // namespace cabinet_articulation
