// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/motion/motion_gate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

const TrackingConfig config;

bool canMove(const Rectangle& from, const Rectangle& to, double seconds) {
  return motionDistance(from, to, seconds, config).has_value();
}

TEST(MotionGate, DoorsSwingAndDrawersComeOut) {
  const Rectangle door = closedFront();
  EXPECT_TRUE(canMove(door, swung(door, 0.35), 0.067)) << "a fast pull between two frames";
  EXPECT_FALSE(canMove(door, swung(door, 1.5), 0.067));
  EXPECT_TRUE(canMove(door, swung(door, 1.5), 1)) << "unseen for a second";
  const Rectangle drawer = closedFront(0, 0.395, 0.125);
  EXPECT_TRUE(canMove(drawer, pulled(drawer, 0.09), 0.067));
  EXPECT_FALSE(canMove(drawer, pulled(drawer, 0.4), 0.067));
  EXPECT_TRUE(canMove(drawer, pulled(drawer, 0.4), 1));
}

TEST(MotionGate, NeighboursOfEqualSizeAreNotTheFrontHoweverLongItIsUnseen) {
  const Rectangle door = closedFront();
  const Rectangle neighbour = closedFront(door.width);
  for (double q = 0; q < 1.6; q += 0.1) EXPECT_FALSE(canMove(door, swung(neighbour, q), 20)) << q;
  Rectangle drawer = closedFront(0, 0.395, 0.125);
  Rectangle below = drawer;
  below.pose.translate(Eigen::Vector3d(0, -0.128, 0));
  for (double q = 0; q < 0.4; q += 0.02) EXPECT_FALSE(canMove(drawer, pulled(below, q), 20)) << q;
}

TEST(MotionGate, TheSidesOfABoxAreNotItsFrontSwungInward) {
  const Rectangle front = closedFront(0, 0.4, 0.4);
  EXPECT_FALSE(canMove(front, swung(front, -M_PI / 2), 2));
  EXPECT_FALSE(canMove(front, describe(swung(front, -M_PI / 2), 6), 2)) << "nor in another description";
  EXPECT_TRUE(canMove(front, swung(front, M_PI / 2), 2));
  EXPECT_TRUE(canMove(swung(front, 0.3), front, 0.067)) << "while it is watched a door may close";
}

TEST(MotionGate, NoFrontTurnsAboutItsNormal) {
  const Rectangle front = closedFront();
  Rectangle turned = front;
  turned.pose.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(canMove(front, turned, 20));
}

TEST(MotionGate, ReachHoldsAllMotions) {
  const Rectangle front = closedFront();
  for (double seconds : {0.067, 0.3, 1.0, 20.0})
    for (double q = -1.7; q < 1.7; q += 0.1) {
      const Rectangle places[] = {swung(front, q), pulled(front, q)};
      for (const Rectangle& to : places)
        EXPECT_TRUE(!canMove(front, to, seconds) || (to.center() - front.center()).norm() < reach(front, seconds, config));
    }
}

TEST(MotionGate, AJumpOfAMetreIsNoMotion) {
  const Rectangle front = closedFront();
  EXPECT_FALSE(canMove(front, closedFront(1), 20));
  EXPECT_FALSE(canMove(front, pulled(front, 1), 20));
}

TEST(MotionGate, WhatFrontsDoCostsAQuarter) {
  const Rectangle front = closedFront();
  EXPECT_NEAR(*motionDistance(front, pulled(front, 0.1), 1, config), 0.025, 1e-9);
  EXPECT_NEAR(*motionDistance(front, swung(front, 1), 1, config), cornerDistance(front, swung(front, 1)) / 4, 1e-9);
  Rectangle slid = front;
  slid.pose.translate(Eigen::Vector3d(0.02, 0, 0));
  EXPECT_NEAR(*motionDistance(front, slid, 1, config), std::hypot(0.02, 0.02 / 4), 1e-9);
}

TEST(CornerDistance, OfAShiftAndOfATurn) {
  const Rectangle front = closedFront();
  EXPECT_NEAR(cornerDistance(front, pulled(front, 0.1)), 0.1, 1e-12);
  // Two corners at the hinge stay, two move along a chord of 2 w sin(q / 2).
  EXPECT_NEAR(cornerDistance(front, swung(front, 0.2)), std::sqrt(0.5) * 2 * front.width * std::sin(0.1), 1e-12);
}

}  // namespace
}  // namespace cabinet_articulation::core
