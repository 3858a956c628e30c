// SPDX-License-Identifier: BSD-3-Clause
#include "closing/front_in_view.h"

#include <gtest/gtest.h>

#include "closing/surface_plane.h"
#include "support/models.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kBand = 0.015;

/// A wall at 1.5 m that fills the image.
DepthView wall() {
  DepthView view;
  view.columns = 80;
  view.rows = 60;
  view.fx = view.fy = 80;
  view.cx = 39.5;
  view.cy = 29.5;
  view.depth.assign(4800, 1.5F);
  return view;
}

Rectangle frontAtDepth(double z) { return {test::facingCamera(0, 0, z), 0.4, 0.3}; }

TEST(FrontInView, IsFullAndGoesOnWhereItLiesInAWall) {
  const FrontInView seen = look(wall(), frontAtDepth(1.5), kBand);
  EXPECT_GT(seen.inside.seen(), 200);
  EXPECT_EQ(seen.inside.in_plane, seen.inside.seen());
  for (const CellCount& side : seen.beside) EXPECT_TRUE(goesOn(side));
  EXPECT_GT(surfaceLogOdds(seen.beside), 5);
  const FrontInView open = look(wall(), frontAtDepth(1.4), kBand);
  EXPECT_EQ(open.inside.behind, open.inside.seen()) << "the wall is behind it";
  EXPECT_LT(surfaceLogOdds(open.beside), -1);
  const FrontInView hidden = look(wall(), frontAtDepth(1.6), kBand);
  EXPECT_EQ(hidden.inside.before, hidden.inside.seen());
}

TEST(FrontInView, FromBehindOrOutOfTheImageShowsNothing) {
  Rectangle turned = frontAtDepth(1.5);
  turned.pose.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()));
  EXPECT_EQ(look(wall(), turned, kBand).inside.seen(), 0);
  Rectangle aside = frontAtDepth(1.5);
  aside.pose.translation().x() = 5;
  EXPECT_EQ(look(wall(), aside, kBand).inside.seen(), 0);
  EXPECT_EQ(surfaceLogOdds(look(wall(), aside, kBand).beside), 0) << "says nothing";
  Rectangle behind_camera = frontAtDepth(-1.5);
  EXPECT_EQ(look(wall(), behind_camera, kBand).inside.seen(), 0);
}

TEST(FrontInView, WhatGoesAlongWithTheFrontIsNoNeighbour) {
  constexpr std::size_t kRight = 2 * kEdgePlusX, kAbove = 2 * kEdgeMinusY, kBelow = 2 * kEdgePlusY;
  OwnEdges edges;
  EXPECT_FALSE(edges.isEdge(kRight)) << "not known yet";
  FrontInView open;
  open.beside[kRight] = {0, 0, 20};
  open.beside[kAbove] = {18, 0, 2};
  edges.add(open.beside, open.inside);
  EXPECT_TRUE(edges.isEdge(kRight));
  EXPECT_FALSE(edges.isEdge(kAbove)) << "the image cut the front there";
  EXPECT_FALSE(edges.isEdge(kBelow)) << "not in view";
}

TEST(FrontInView, ANeighbourMayBeHalfAsHigh) {
  DepthView view = wall();
  for (int row = 0; row < view.rows / 2; ++row)
    for (int column = 0; column < view.columns; ++column) view.depth[row * view.columns + column] = 2;
  const FrontInView seen = look(view, frontAtDepth(1.5), kBand);
  int along = 0;
  for (const CellCount& side : seen.beside) {
    EXPECT_GT(side.seen(), 3);
    along += goesOn(side) ? 1 : 0;
  }
  EXPECT_EQ(along, 4) << "both halves of the lower edge, and the lower halves of those left and right";
}

TEST(FrontInView, IsBetweenSurfacesThatAreSeenAtOppositeEdges) {
  const auto blinded = [](const std::vector<Edge>& edges) {
    CellsBeside beside;
    beside.fill({20, 0, 0, 0});
    for (const Edge edge : edges) beside[2 * edge] = beside[2 * edge + 1] = {4, 0, 0, 16};
    return beside;
  };
  EXPECT_TRUE(isBetweenSurfaces(blinded({})));
  EXPECT_TRUE(isBetweenSurfaces(blinded({kEdgeMinusY, kEdgePlusY})));
  EXPECT_FALSE(isBetweenSurfaces(blinded({kEdgeMinusX, kEdgePlusY})));
  EXPECT_FALSE(isBetweenSurfaces({})) << "nothing is in view";
}

TEST(FrontInView, CountsCellsWithoutDepthBesideToo) {
  DepthView blind = wall();
  blind.depth.assign(blind.depth.size(), 0);
  const CellsBeside seen = look(wall(), frontAtDepth(1.5), kBand).beside;
  const CellsBeside unseen = look(blind, frontAtDepth(1.5), kBand).beside;
  for (std::size_t side = 0; side < kSides; ++side) EXPECT_EQ(unseen[side].blind, seen[side].seen());
}

TEST(FrontInView, HowMuchOfAFrontIsThereIsSeenWhereItIsOpen) {
  OwnEdges edges;
  EXPECT_FALSE(edges.fill()) << "not known yet";
  FrontInView open;
  open.inside = {40, 15, 60};
  edges.add(open.beside, open.inside);
  ASSERT_TRUE(edges.fill());
  EXPECT_DOUBLE_EQ(*edges.fill(), 0.4) << "what is before it hides it";
}

TEST(SurfacePlane, IsFoundBesideAHandle) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 10; ++j) {
      const double x = 0.02 * i - 0.2, y = 0.03 * j - 0.15;
      // A bar stands 2 cm out at one side; the rest wobbles by a millimetre.
      points.emplace_back(x, y, 0.01 + 0.05 * x - 0.02 * y + (i == 18 ? 0.02 : 0.001 * ((i + j) % 2)));
    }
  const std::optional<SurfacePlane> plane = fitSurface(points);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->c(0), 0.0105, 3e-4);
  EXPECT_NEAR(plane->c(1), 0.05, 2e-3);
  EXPECT_NEAR(plane->c(2), -0.02, 2e-3);
  points.resize(4);
  EXPECT_FALSE(fitSurface(points)) << "too few";
  EXPECT_FALSE(fitSurface(std::vector<Eigen::Vector3d>(30, Eigen::Vector3d(0.1, 0.1, 0)))) << "one place is no plane";
}

}  // namespace
}  // namespace cabinet_articulation::core
