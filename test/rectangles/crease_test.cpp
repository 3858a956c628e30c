// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/crease.h"

#include <gtest/gtest.h>

#include "edge_profiles.h"
#include "front_scene.h"

namespace cabinet_articulation::core {
namespace {

/// A door opened by some 20 degrees at 1.3 m: both planes meet 7 px inside its edge, where they part by 0.03 px a pixel.
const Neighbour kBesideADoor{0.2, 0.03, 0.35, {}};

/// The door up to `border`, then its neighbour.
std::optional<Crease> creaseAt(double border, double noise, const Neighbour& neighbour = kBesideADoor) {
  const auto on_plane = profileOf([&](double x) { return x < border ? 0 : neighbour.at(x); }, noise);
  const auto on_neighbour = profileOf([&](double x) { return x < border ? -neighbour.at(x) : 0; }, noise);
  return findCrease(on_plane, on_neighbour, neighbour);
}

TEST(CreaseTest, FindsWhereTheNeighbourBegins) {
  for (const double border : {-3.0, 0.0, 2.5}) {
    const auto crease = creaseAt(border, 0.005);
    ASSERT_TRUE(crease) << border;
    EXPECT_NEAR(crease->offset, border, EdgeProfile::kStripWidth);
    EXPECT_NEAR(crease->nearer, kBesideADoor.at(border), 0.03);
  }
}

TEST(CreaseTest, SaysNothingWhereEitherPlaneWouldDo) {
  EXPECT_FALSE(creaseAt(100, 0.005));   // the door goes on
  EXPECT_FALSE(creaseAt(-100, 0.005));  // the neighbour is there from the beginning
  EXPECT_FALSE(creaseAt(0, 0.3));       // too little texture to tell them apart
  const auto nothing = profileOf([](double) { return kNone; });
  EXPECT_FALSE(findCrease(nothing, nothing, kBesideADoor));
}

TEST(CreaseTest, WhatLiesFartherAwayHidesNothing) { EXPECT_FALSE(creaseAt(0, 0.005, {-0.5, 0.03, 0.35, {}})); }

class NeighbourTest : public testing::Test {
 protected:
  std::optional<Neighbour> beyondRightEdge(const Rectangle& other) const {
    const PlaneRegion region = frontRegion(front_, camera_);
    const PlaneChart chart = *PlaneChart::at(region.plane, camera_, {318, 243});
    const ImageEdge edge = *imageEdge(chart, chart.fromSpace(front_), kEdgePlusX);
    return neighbourBeyond(edge, region, {region, frontRegion(other, camera_)});
  }

  const StereoCamera camera_ = exampleCamera();
  const Rectangle front_ = exampleFront({0, 0, 1.3}, 0.4, 0.3, -0.3, 0, 0);  ///< its right side is farther away
};

TEST_F(NeighbourTest, IsTheRegionBeyondTheEdge) {
  // It begins at the front's edge and faces the camera.
  const Eigen::Vector3d hinge = front_.pose * Eigen::Vector3d(0.2, 0, 0);
  const auto neighbour = beyondRightEdge(exampleFront(hinge + Eigen::Vector3d(0.15, 0, 0), 0.3, 0.3, 0, 0, 0));
  ASSERT_TRUE(neighbour);
  EXPECT_NEAR(neighbour->at_edge, 0, 1e-3);
  EXPECT_NEAR(neighbour->angle, 0.3, 1e-6);
  // d = f B n.r / offset; 10 px outward both planes are that far apart along one ray.
  const ImageEdge edge = [&] {
    const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, {318, 243});
    return *imageEdge(chart, chart.fromSpace(front_), kEdgePlusX);
  }();
  const Eigen::Vector2d pixel = (edge.a + edge.b) / 2 + 10 * edge.outward;
  const double z_front = front_.plane().intersect(camera_.ray(pixel.x(), pixel.y()))->z();
  const double expected = camera_.disparity(hinge.z()) - camera_.disparity(z_front);
  EXPECT_NEAR(neighbour->at(10), expected, 1e-3);
}

TEST_F(NeighbourTest, IsNothingThatGoesBackOrMeetsThePlaneFarAway) {
  const Eigen::Vector3d hinge = front_.pose * Eigen::Vector3d(0.2, 0, 0);
  EXPECT_FALSE(beyondRightEdge(exampleFront(hinge + Eigen::Vector3d(0.15, 0, 0.13), 0.3, 0.3, -0.8, 0, 0)));
  EXPECT_FALSE(beyondRightEdge(exampleFront(hinge + Eigen::Vector3d(0.15, 0, -0.2), 0.3, 0.3, 0, 0, 0)));
}

TEST_F(NeighbourTest, IsNothingElsewhereOrInNearlyTheSamePlane) {
  EXPECT_FALSE(beyondRightEdge(exampleFront({-0.5, 0, 1.3}, 0.3, 0.3, 0, 0, 0)));
  Rectangle same = front_;
  same.pose.translation() += 0.4 * front_.pose.linear().col(0);
  EXPECT_FALSE(beyondRightEdge(same));
}

}  // namespace
}  // namespace cabinet_articulation::core
