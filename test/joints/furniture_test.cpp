// SPDX-License-Identifier: BSD-3-Clause
#include "joints/furniture.h"

#include <gmock/gmock.h>

#include <random>

#include "cabinet_articulation/joints/prediction.h"
#include "support/models.h"

namespace cabinet_articulation::core {
namespace {

using testing::ElementsAre;

constexpr double kPosition = 0.004, kDirection = 0.01;  // [m, rad] what a front's pose is uncertain by

std::vector<std::vector<std::size_t>> indices(const std::vector<LearnedModel>& joints) {
  std::vector<std::vector<std::size_t>> result;
  for (const PieceOfFurniture& piece : piecesOfFurniture(joints)) result.push_back(piece.fronts);
  return result;
}

/// A drawer 0.4 m wide and 0.2 m high, facing the camera; known as well as fronts usually are.
LearnedModel drawerAt(double x, double y, double z, double sigma_position = kPosition, double sigma_direction = kDirection) {
  LearnedModel drawer = test::drawerModel();
  drawer.origin = test::facingCamera(x, y, z);
  drawer.height = 0.2;
  drawer.q_closed = 0;
  drawer.closed_known = true;
  drawer.covariance.diagonal().head<3>().setConstant(sigma_position * sigma_position);
  drawer.covariance.diagonal().tail<3>().setConstant(sigma_direction * sigma_direction);
  drawer.position_error = sigma_position;
  drawer.orientation_error = sigma_direction;
  return drawer;
}

/// As it would be learned: off by what its pose is uncertain by.
LearnedModel noisy(LearnedModel model, std::mt19937* random) {
  std::normal_distribution<double> normal;
  const Matrix6d covariance = predictWithCovariance(model, 0).covariance;
  Eigen::Vector3d shift, turn;
  for (int i = 0; i < 3; ++i) {
    shift[i] = std::sqrt(covariance(i, i)) * normal(*random);
    turn[i] = std::sqrt(covariance(i + 3, i + 3)) * normal(*random);
  }
  model.origin.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * model.origin.linear();
  model.origin.translation() += shift;
  return model;
}

/// In how many of 1000 noisy observations the two are one piece.
int timesTogether(const LearnedModel& a, const LearnedModel& b) {
  std::mt19937 random(1);
  int times = 0;
  for (int i = 0; i < 1000; ++i) times += piecesOfFurniture({noisy(a, &random), noisy(b, &random)}).size() == 1;
  return times;
}

TEST(Furniture, FrontsOfOneSurfaceAreOnePiece) {
  EXPECT_GT(timesTogether(drawerAt(0, 0, 1.5), drawerAt(0.41, 0, 1.5)), 980);
  EXPECT_GT(timesTogether(drawerAt(0, 0, 1.5), drawerAt(0, 0.6, 1.5)), 980) << "with a drawer between them";
  EXPECT_GT(timesTogether(drawerAt(0, 0, 1.5, 0.001, 0.002), drawerAt(0.41, 0, 1.502, 0.001, 0.002)), 980)
      << "fronts are not quite flush";
}

TEST(Furniture, FrontsOfOtherSurfacesAreOthers) {
  EXPECT_LT(timesTogether(drawerAt(0, 0, 1.5), drawerAt(0.41, 0, 1.55)), 20) << "farther back";
  EXPECT_EQ(timesTogether(drawerAt(0, 0, 1.5), drawerAt(0.41, 0, 1.75)), 0) << "wall units are less deep";
  LearnedModel turned = drawerAt(0.41, 0, 1.5);
  turned.origin.rotate(Eigen::AngleAxisd(0.17, Eigen::Vector3d::UnitY()));
  EXPECT_LT(timesTogether(drawerAt(0, 0, 1.5), turned), 20) << "turned by 10 degrees";
  LearnedModel corner = drawerAt(0.21, 0, 1.29);
  corner.origin.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));
  EXPECT_EQ(timesTogether(drawerAt(0, 0, 1.5), corner), 0);
  LearnedModel behind = drawerAt(0.41, 0, 1.5);
  behind.origin.rotate(Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()));
  EXPECT_EQ(timesTogether(drawerAt(0, 0, 1.5), behind), 0) << "faces the other side";
}

TEST(Furniture, AUnitFitsInBetweenAndNotTwo) {
  EXPECT_EQ(piecesOfFurniture({drawerAt(0, 0, 1.5), drawerAt(0.99, 0, 1.5)}).size(), 1u);
  EXPECT_EQ(piecesOfFurniture({drawerAt(0, 0, 1.5), drawerAt(1.01, 0, 1.5)}).size(), 2u);
  EXPECT_EQ(piecesOfFurniture({drawerAt(0, 0, 1.5), drawerAt(0.9, 0.6, 1.5)}).size(), 2u) << "0.64 m from corner to corner";
  EXPECT_THAT(indices({drawerAt(0, 0, 1.5), drawerAt(2, 0, 1.5), drawerAt(1.01, 0.1, 1.5), drawerAt(0.5, 0, 1.5)}),
              ElementsAre(ElementsAre(0, 1, 2, 3)))
      << "what is connected by others is one piece";
}

TEST(Furniture, OrderIsThatOfTheModels) {
  const LearnedModel a = drawerAt(0, 0, 1.5), b = drawerAt(0.41, 0, 1.5), other = drawerAt(0, 0, 2.5);
  EXPECT_THAT(indices({other, a, b}), ElementsAre(ElementsAre(0), ElementsAre(1, 2)));
  EXPECT_THAT(indices({a, other, b}), ElementsAre(ElementsAre(0, 2), ElementsAre(1)));
  EXPECT_TRUE(piecesOfFurniture({}).empty());
}

TEST(Furniture, WhatIsKnownBadlyJoinsNothing) {
  EXPECT_EQ(piecesOfFurniture({drawerAt(0, 0, 1.5), drawerAt(0.41, 0, 1.5, 0.5)}).size(), 2u);
}

/// A door whose hinge is at x = -0.1 in the surface at z = 1.2. Its q is 0 where it was seen first, at this opening.
LearnedModel doorFirstSeenAt(double opening) {
  LearnedModel door = test::doorModel();
  door.covariance = drawerAt(0, 0, 1).covariance;
  door.origin = door.predict(opening);
  return door;
}

TEST(Furniture, ADoorFirstSeenOpenBelongsWhereItIsClosed) {
  const LearnedModel drawer = drawerAt(0.1, 0.42, 1.2);
  EXPECT_EQ(piecesOfFurniture({doorFirstSeenAt(0), drawer}).size(), 1u);
  LearnedModel open = doorFirstSeenAt(0.8);
  EXPECT_EQ(piecesOfFurniture({open, drawer}).size(), 2u) << "nobody knows how far it closes";
  open.q_closed = -0.8;
  open.closed_known = true;
  EXPECT_EQ(piecesOfFurniture({open, drawer}).size(), 1u);
  for (const double nowhere : {std::nan(""), 1e300}) {
    open.q_closed = nowhere;
    EXPECT_EQ(piecesOfFurniture({open, drawer}).size(), 2u);
  }
  open.closed_known = false;
  open.q_min = -0.8;
  EXPECT_EQ(piecesOfFurniture({open, drawer}).size(), 1u) << "it was seen there later";
}

TEST(Furniture, ADoorFirstSeenAjarBelongsToTheSurfaceThatItsHingeIsIn) {
  const LearnedModel drawer = drawerAt(0.1, 0.42, 1.2), farther = drawerAt(0.1, 0.42, 1.3);
  const LearnedModel ajar = doorFirstSeenAt(0.2);
  EXPECT_GT(timesTogether(ajar, drawer), 950);
  EXPECT_LT(timesTogether(ajar, farther), 20);
  const auto pieces = piecesOfFurniture({ajar, drawer});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_TRUE(pieces[0].closed[0].isApprox(test::doorModel().origin, 1e-6)) << "0.2 rad beyond what was seen";
  EXPECT_TRUE(pieces[0].closed[1].isApprox(drawer.origin));
  LearnedModel known = ajar;
  known.q_closed = 0;
  known.closed_known = true;
  EXPECT_EQ(piecesOfFurniture({known, drawer}).size(), 2u) << "closed, it lies in no plane with the drawer";
}

TEST(Furniture, ADrawerFirstSeenStandingOutBelongsToTheSurfaceCloseBehind) {
  LearnedModel drawer = drawerAt(0, 0, 1.5);
  drawer.closed_known = false;
  EXPECT_GT(timesTogether(drawer, drawerAt(0.41, 0, 1.5)), 980);
  EXPECT_GT(timesTogether(drawer, drawerAt(0.41, 0, 1.527)), 980);
  EXPECT_LT(timesTogether(drawer, drawerAt(0.41, 0, 1.45)), 20) << "it never closes outwards";
  EXPECT_EQ(timesTogether(drawer, drawerAt(0.41, 0, 1.6)), 0);
  const auto pieces = piecesOfFurniture({drawer, drawerAt(0.41, 0, 1.527)});
  ASSERT_EQ(pieces.size(), 1u);
  EXPECT_NEAR(pieces[0].closed[0].translation().z(), 1.527, 1e-9);
  LearnedModel out = drawerAt(0.1, 0.42, 1.18);
  out.closed_known = false;
  EXPECT_GT(timesTogether(out, doorFirstSeenAt(0.2)), 950) << "both first seen ajar";
  const auto ajar = piecesOfFurniture({out, doorFirstSeenAt(0.2)});
  ASSERT_EQ(ajar.size(), 1u);
  for (const Eigen::Isometry3d& closed : ajar[0].closed) EXPECT_NEAR(closed.translation().z(), 1.2, 1e-6);
}

}  // namespace
}  // namespace cabinet_articulation::core
