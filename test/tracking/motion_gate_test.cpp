// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/motion_gate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

const TrackingConfig config;

TEST(MotionGate, DoorsSwingAndDrawersComeOut) {
  const Rectangle door = closedFront();
  EXPECT_TRUE(isPossibleMotion(door, swung(door, 0.35), 0.067, config)) << "a fast pull between two frames";
  EXPECT_FALSE(isPossibleMotion(door, swung(door, 1.5), 0.067, config));
  EXPECT_TRUE(isPossibleMotion(door, swung(door, 1.5), 1, config)) << "unseen for a second";
  EXPECT_TRUE(isPossibleMotion(swung(door, 1.5), door, 1, config)) << "and back";
  const Rectangle drawer = closedFront(0, 0.395, 0.125);
  EXPECT_TRUE(isPossibleMotion(drawer, pulled(drawer, 0.1), 0.067, config));
  EXPECT_FALSE(isPossibleMotion(drawer, pulled(drawer, 0.4), 0.067, config));
  EXPECT_TRUE(isPossibleMotion(drawer, pulled(drawer, 0.4), 1, config));
}

TEST(MotionGate, NeighboursOfEqualSizeAreNotTheFrontHoweverLongItIsUnseen) {
  const Rectangle door = closedFront();
  const Rectangle neighbour = closedFront(door.width);
  for (double q = 0; q < 1.6; q += 0.1) EXPECT_FALSE(isPossibleMotion(door, swung(neighbour, q), 20, config)) << q;
  Rectangle drawer = closedFront(0, 0.395, 0.125);
  Rectangle below = drawer;
  below.pose.translate(Eigen::Vector3d(0, -0.128, 0));
  for (double q = 0; q < 0.4; q += 0.02) EXPECT_FALSE(isPossibleMotion(drawer, pulled(below, q), 20, config)) << q;
}

TEST(MotionGate, NoFrontTurnsAboutItsNormal) {
  const Rectangle front = closedFront();
  Rectangle turned = front;
  turned.pose.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
  EXPECT_FALSE(isPossibleMotion(front, turned, 20, config));
}

TEST(MotionGate, AJumpOfAMetreIsNoMotion) {
  const Rectangle front = closedFront();
  EXPECT_FALSE(isPossibleMotion(front, closedFront(1), 20, config));
  EXPECT_FALSE(isPossibleMotion(front, pulled(front, 1), 20, config));
}

TEST(CornerDistance, OfAShiftAndOfATurn) {
  const Rectangle front = closedFront();
  EXPECT_NEAR(cornerDistance(front, pulled(front, 0.1)), 0.1, 1e-12);
  // Two corners at the hinge stay, two move along a chord of 2 w sin(q / 2).
  EXPECT_NEAR(cornerDistance(front, swung(front, 0.2)), std::sqrt(0.5) * 2 * front.width * std::sin(0.1), 1e-12);
}

}  // namespace
}  // namespace cabinet_articulation::core
