// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cabinet_builder.h"
#include "simulation/scene_factories.h"

namespace cabinet_articulation::core {
namespace {

using Eigen::Vector3d;

constexpr double kDepth = 0.5;       // [m] of a cupboard
constexpr double kWallBehind = 0.6;  // [m] y of the wall
constexpr double kTopThickness = 0.022;

double randomGap(cv::RNG* random) { return random->uniform(0.003, 0.004); }

/// From a little to one side, above the fronts; an arm comes from the same side.
void look(const Vector3d& target, double distance, double azimuth, double elevation, Scene* scene) {
  scene->view_target = target;
  scene->view_point = viewPoint(target, distance, azimuth, elevation);
  scene->shoulder = target + Vector3d(0, -0.5, 1.0);
}

}  // namespace

Scene makeBifold(cv::RNG* random) {
  Scene scene;
  const Materials materials = Materials::random(random);
  CabinetBuilder builder(&scene, materials, randomGap(random));
  const double width = random->uniform(0.36, 0.40), bottom = 0.1, top = bottom + random->uniform(0.66, 0.70);
  const double q_max = radians(random->uniform(42, 48));
  builder.addCarcass({-width, width, bottom, top}, kDepth);
  builder.addShelf({-width, width, bottom, top}, (bottom + top) / 2, kDepth - 0.05);
  builder.addFixedBox({-width, 0, top + 0.003}, {width, kDepth, top + 0.003 + kTopThickness}, materials.worktop);
  // The rail keeps the second leaf's far edge in the plane of the closed door: it turns back by twice as much.
  builder.addDoor("first_leaf", {-width, 0, bottom, top}, true, q_max);
  builder.hangOnLastJoint();
  builder.addSecondLeaf("second_leaf", {0, width, bottom, top}, 2 * q_max);
  builder.addWallAndFloor(kWallBehind);
  const double elevation = radians(random->uniform(22, 27)), azimuth = radians(random->uniform(-5, 5)),
               distance = random->uniform(1.45, 1.55);
  look({0, -0.1, (bottom + top) / 2}, distance, azimuth, elevation, &scene);
  return scene;
}

Scene makeTrolley(cv::RNG* random) {
  Scene scene;
  const Materials materials = Materials::random(random);
  CabinetBuilder builder(&scene, materials, randomGap(random));
  constexpr double kTravel = 0.5, kTrolleyDepth = 0.45;
  const double width = random->uniform(0.42, 0.46), bottom = 0.08;
  const double x0 = -(width + kTravel) / 2, x1 = x0 + width;
  const double face = bottom + random->uniform(0.26, 0.29), middle = face + random->uniform(0.15, 0.17);
  const double top = middle + random->uniform(0.14, 0.16);
  builder.addPushedFace("face", {x0, x1, bottom, top}, {x0, x1, bottom, face}, kTravel,
                        {(x0 + x1) / 2, 0.05, top + kTopThickness});
  builder.hangOnLastJoint();
  builder.addCarcass({x0, x1, bottom, top}, kTrolleyDepth);
  builder.addFixedBox({x0, 0, top + 0.003}, {x1, kTrolleyDepth, top + kTopThickness}, materials.worktop);
  for (const double x : {x0 + 0.05, x1 - 0.05})
    for (const double y : {0.07, kTrolleyDepth - 0.05})
      builder.addFixedBox({x - 0.02, y - 0.02, 0}, {x + 0.02, y + 0.02, bottom}, materials.plinth);
  builder.addDrawer("drawer_1", {x0, x1, face, middle}, random->uniform(0.26, 0.32));
  builder.addDrawer("drawer_2", {x0, x1, middle, top}, random->uniform(0.26, 0.32));
  builder.addWallAndFloor(kWallBehind);
  const double elevation = radians(random->uniform(25, 30)), azimuth = radians(random->uniform(-8, 8)),
               distance = random->uniform(1.45, 1.55);
  look({0, -0.1, (bottom + top) / 2 + 0.02}, distance, azimuth, elevation, &scene);
  return scene;
}

Scene makeCupboard(cv::RNG* random) {
  Scene scene;
  const Materials materials = Materials::random(random);
  CabinetBuilder builder(&scene, materials, randomGap(random));
  constexpr double kInside = 0.06;  // [m] behind the door's surface
  const double width = random->uniform(0.54, 0.58), bottom = 0.1, top = bottom + random->uniform(0.56, 0.60);
  const double x0 = -width / 2, x1 = width / 2, drawer_top = bottom + random->uniform(0.24, 0.27);
  builder.addCarcass({x0, x1, bottom, top}, kDepth);
  builder.addFixedBox({x0, 0, top + 0.003}, {x1, kDepth, top + 0.003 + kTopThickness}, materials.worktop);
  builder.addShelf({x0, x1, bottom, top}, drawer_top + 0.02, kDepth - 0.05);
  builder.addDoor("door", {x0, x1, bottom, top}, true, radians(random->uniform(95, 100)));
  builder.keepLastJointOpen();
  // Beside the open door, which would otherwise be in its way.
  builder.addDrawer("drawer", {x0 + 0.06, x1 - 0.03, bottom + 0.03, drawer_top}, random->uniform(0.22, 0.27), kInside);
  builder.addWallAndFloor(kWallBehind);
  const double elevation = radians(random->uniform(24, 29)), azimuth = radians(random->uniform(4, 10)),
               distance = random->uniform(1.4, 1.5);
  look({0, -0.15, (bottom + top) / 2}, distance, azimuth, elevation, &scene);
  scene.shoulder.x() += 0.1;
  return scene;
}

}  // namespace cabinet_articulation::core
