// SPDX-License-Identifier: BSD-3-Clause
#include "joints/furniture.h"

#include <gmock/gmock.h>

#include <random>

#include "cabinet_articulation/joints/prediction.h"
#include "support/models.h"

namespace cabinet_articulation::core {
namespace {

using testing::ElementsAre;
using Pieces = std::vector<std::vector<std::size_t>>;

constexpr double kPosition = 0.004, kDirection = 0.01;  // [m, rad] what a front's pose is uncertain by

/// A drawer 0.4 m wide and 0.2 m high, facing the camera; known as well as fronts usually are.
LearnedModel drawerAt(double x, double y, double z, double sigma_position = kPosition, double sigma_direction = kDirection) {
  LearnedModel drawer = test::drawerModel();
  drawer.origin = test::facingCamera(x, y, z);
  drawer.height = 0.2;
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
  EXPECT_THAT(piecesOfFurniture({drawerAt(0, 0, 1.5), drawerAt(2, 0, 1.5), drawerAt(1.01, 0.1, 1.5), drawerAt(0.5, 0, 1.5)}),
              ElementsAre(ElementsAre(0, 1, 2, 3)))
      << "what is connected by others is one piece";
}

TEST(Furniture, OrderIsThatOfTheModels) {
  const LearnedModel a = drawerAt(0, 0, 1.5), b = drawerAt(0.41, 0, 1.5), other = drawerAt(0, 0, 2.5);
  EXPECT_THAT(piecesOfFurniture({other, a, b}), ElementsAre(ElementsAre(0), ElementsAre(1, 2)));
  EXPECT_THAT(piecesOfFurniture({a, other, b}), ElementsAre(ElementsAre(0, 2), ElementsAre(1)));
  EXPECT_TRUE(piecesOfFurniture({}).empty());
}

TEST(Furniture, WhatIsKnownBadlyJoinsNothing) {
  EXPECT_EQ(piecesOfFurniture({drawerAt(0, 0, 1.5), drawerAt(0.41, 0, 1.5, 0.5)}).size(), 2u);
}

TEST(Furniture, ADoorFirstSeenOpenBelongsWhereItIsClosed) {
  LearnedModel door = test::doorModel();  // its hinge is at x = -0.1, its surface at z = 1.2
  door.covariance = drawerAt(0, 0, 1).covariance;
  const LearnedModel drawer = drawerAt(0.1, 0.42, 1.2);
  EXPECT_EQ(piecesOfFurniture({door, drawer}).size(), 1u);
  LearnedModel open = door;
  open.origin = door.predict(0.8);
  EXPECT_EQ(piecesOfFurniture({open, drawer}).size(), 2u) << "nobody knows that it is open";
  open.q_closed = -0.8;
  open.closed_known = true;
  EXPECT_EQ(closedConfiguration(open), -0.8);
  EXPECT_EQ(piecesOfFurniture({open, drawer}).size(), 1u);
  for (const double nowhere : {std::nan(""), 1e300}) {
    open.q_closed = nowhere;
    EXPECT_EQ(closedConfiguration(open), 0);
  }
}

}  // namespace
}  // namespace cabinet_articulation::core
