// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cabinet_scenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cabinet_articulation::core {
namespace {

Scene scene(const std::string& name, int seed = 1, const std::string& hinge = "left") {
  SimulationConfig config;
  config.scene = name;
  config.scene_seed = seed;
  config.hinge = hinge;
  return makeScene(config);
}

std::vector<Rectangle> fronts(const Scene& scene) {
  std::vector<Rectangle> fronts;
  for (const Joint& joint : scene.joints) fronts.push_back(joint.front);
  for (const FixedFront& front : scene.fixed)
    if (front.name != "wall" && front.name != "floor") fronts.push_back(front.rectangle);
  return fronts;
}

TEST(CabinetScenes, HaveTheJointsTheyPromise) {
  const auto types = [](const Scene& scene) {
    int prismatic = 0, rotational = 0;
    for (const Joint& joint : scene.joints) {
      prismatic += joint.type == JointType::kPrismatic;
      rotational += joint.type == JointType::kRotational;
    }
    return std::make_pair(prismatic, rotational);
  };
  EXPECT_EQ(types(scene("door")), std::make_pair(0, 1));
  EXPECT_EQ(types(scene("drawer")), std::make_pair(1, 0));
  EXPECT_EQ(types(scene("kitchen")), std::make_pair(1, 1));
  EXPECT_EQ(types(scene("pedestal")), std::make_pair(2, 0));
  EXPECT_EQ(types(scene("bifold")), std::make_pair(0, 2));
  EXPECT_EQ(types(scene("trolley")), std::make_pair(3, 0));
  EXPECT_EQ(types(scene("cupboard")), std::make_pair(1, 1));
  EXPECT_EQ(types(scene("static")), std::make_pair(0, 0));
  EXPECT_GE(fronts(scene("static")).size(), 10U);
}

TEST(CabinetScenes, ClosedFrontsAreFlushWithGapsOfThreeToFourMillimetres) {
  for (const char* name : {"door", "drawer", "kitchen", "pedestal", "bifold", "static"}) {
    for (int seed = 1; seed <= 5; ++seed) {
      const std::vector<Rectangle> all = fronts(scene(name, seed));
      for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i].center().y(), 0);
        EXPECT_TRUE(all[i].normal().isApprox(-Eigen::Vector3d::UnitY(), 1e-12));
        double nearest = 1;
        for (size_t k = 0; k < all.size(); ++k) {
          if (i == k) continue;
          const Eigen::Vector3d between = (all[i].center() - all[k].center()).cwiseAbs();
          const double gap =
              std::max(between.x() - (all[i].width + all[k].width) / 2, between.z() - (all[i].height + all[k].height) / 2);
          nearest = std::min(nearest, gap);
        }
        EXPECT_GE(nearest, 0.003 - 1e-9) << name << ' ' << seed;
        EXPECT_LE(nearest, 0.004 + 1e-9) << name << ' ' << seed;
      }
    }
  }
}

TEST(CabinetScenes, DoorsTurnOutOfTheirHingeSide) {
  for (const char* hinge : {"left", "right"}) {
    const Scene door_scene = scene("door", 3, hinge);
    const Joint& door = door_scene.joints[0];
    const double side = hinge == std::string("left") ? -1 : 1;
    EXPECT_GT(side * (door.axis_point - door.front.center()).x(), 0.9 * door.front.width / 2);
    EXPECT_NEAR((door.axis_point - door.front.center()).z(), 0, 1e-12);
    const Rectangle open{door.motion(door.q_max) * door.front.pose, door.front.width, door.front.height};
    EXPECT_LT(open.center().y(), -0.8 * door.front.width / 2) << "into the room";
    EXPECT_GT(open.normal().dot(door_scene.view_point - open.center()), 0) << "the camera sees the front, not its back";
  }
}

TEST(CabinetScenes, SizesAreThoseOfRealFrontsAndVaryBySomePerCent) {
  double smallest = 1, largest = 0;
  for (int seed = 1; seed <= 20; ++seed) {
    const Joint door = scene("door", seed).joints[0];
    EXPECT_NEAR(door.front.width, 0.40, 0.02);
    EXPECT_NEAR(door.front.height, 0.575, 0.025);
    EXPECT_NEAR(door.q_max, 80 * EIGEN_PI / 180, 0.09);
    smallest = std::min(smallest, door.front.width);
    largest = std::max(largest, door.front.width);
    const Joint drawer = scene("drawer", seed).joints[0];
    EXPECT_NEAR(drawer.front.height, 0.125, 0.01);
    EXPECT_NEAR(drawer.q_max, 0.3, 0.031);
  }
  EXPECT_GT(largest - smallest, 0.01);
}

TEST(CabinetScenes, HangWhatTheySayOnWhatTheySay) {
  const auto parents = [](const std::string& name) {
    std::vector<int> parents;
    for (const Joint& joint : scene(name).joints) parents.push_back(joint.parent);
    return parents;
  };
  EXPECT_EQ(parents("kitchen"), std::vector<int>({kFixedPart, kFixedPart}));
  EXPECT_EQ(parents("bifold"), std::vector<int>({kFixedPart, 0}));
  EXPECT_EQ(parents("trolley"), std::vector<int>({kFixedPart, 0, 0}));
  EXPECT_EQ(parents("cupboard"), std::vector<int>({kFixedPart, kFixedPart}));
}

TEST(CabinetScenes, FoldingDoorKeepsItsFarEdgeOnTheRail) {
  for (int seed = 1; seed <= 5; ++seed) {
    const Scene bifold = scene("bifold", seed);
    const Joint &first = bifold.joints[0], &second = bifold.joints[1];
    for (const double share : {0.0, 0.5, 1.0}) {
      const Eigen::Isometry3d leaf = bifold.motionsAt({share * first.q_max, share * second.q_max})[1] * second.front.pose;
      const Eigen::Vector3d edge = leaf * Eigen::Vector3d(second.front.width / 2, 0, 0);
      EXPECT_NEAR(edge.y(), 0, 0.03) << seed << ": to the thickness of the leaves";
    }
  }
}

TEST(CabinetScenes, TrolleyTakesItsDrawersAlong) {
  const Scene trolley = scene("trolley");
  const Eigen::Isometry3d drawer = trolley.motionsAt({0.5, 0.2, 0})[1] * trolley.joints[1].front.pose;
  const Eigen::Vector3d moved = drawer.translation() - trolley.joints[1].front.center();
  EXPECT_TRUE(moved.isApprox(Eigen::Vector3d(0.5, -0.2, 0), 1e-12)) << moved.transpose();
}

TEST(CabinetScenes, SeedAloneDecides) {
  const Scene a = scene("kitchen", 4), b = scene("kitchen", 4), c = scene("kitchen", 5);
  ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
  for (size_t i = 0; i < a.surfaces.size(); ++i) {
    EXPECT_EQ(a.surfaces[i].rectangle.pose.matrix(), b.surfaces[i].rectangle.pose.matrix());
    EXPECT_EQ(a.surfaces[i].reflectance, b.surfaces[i].reflectance);
  }
  EXPECT_NE(a.joints[0].front.width, c.joints[0].front.width);
}

TEST(CabinetScenes, ArmIsRoundStartsAtTheGripAndPointsToTheShoulder) {
  const Eigen::Vector3d grip(0.1, -0.2, 0.5), shoulder(0.2, -0.8, 1.4);
  const Eigen::Vector3d forward = (shoulder - grip).normalized();
  double nearest = 1, along = 0;
  for (const Surface& surface : makeArm(grip, shoulder)) {
    const Rectangle& side = surface.rectangle;
    const Eigen::Vector3d from_axis = (side.center() - grip) - forward * forward.dot(side.center() - grip);
    const bool is_cap = std::abs(side.normal().dot(forward)) > 0.5;
    EXPECT_GT(is_cap ? -side.normal().dot(forward) : side.normal().dot(from_axis), 0.01) << "faces outward";
    EXPECT_TRUE(is_cap || side.width < 0.045) << side.width << " m wide: looks like a front";
    for (const Eigen::Vector3d& corner : surface.rectangle.corners()) {
      nearest = std::min(nearest, (corner - grip).norm());
      along = std::max(along, (corner - grip).dot((shoulder - grip).normalized()));
    }
  }
  EXPECT_LT(nearest, 0.06);
  EXPECT_NEAR(along, 0.7, 1e-9);
}

}  // namespace
}  // namespace cabinet_articulation::core
