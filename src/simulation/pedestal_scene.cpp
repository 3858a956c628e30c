// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cabinet_builder.h"
#include "simulation/scene_factories.h"

namespace cabinet_articulation::core {
namespace {

using Eigen::Vector3d;

constexpr int kDrawers = 3;

void addRoom(const Materials& materials, CabinetBuilder* builder) {
  builder->addWallAndFloor(1.1);
  // A desk beside it and a waste bin.
  builder->addFixedBox({0.35, -0.05, 0.70}, {1.75, 0.75, 0.725}, materials.worktop);
  builder->addFixedBox({0.37, 0.0, 0.0}, {0.39, 0.70, 0.70}, materials.body);
  builder->addFixedBox({-0.75, 0.15, 0.0}, {-0.5, 0.40, 0.33}, 0.35);
}

}  // namespace

Scene makePedestal(cv::RNG* random) {
  Scene scene;
  const Materials materials = Materials::random(random);
  CabinetBuilder builder(&scene, materials, random->uniform(0.003, 0.004));
  const double width = random->uniform(0.40, 0.44);
  const double depth = random->uniform(0.54, 0.60);
  const double bottom = random->uniform(0.05, 0.07);
  const double heights[kDrawers] = {random->uniform(0.26, 0.29), random->uniform(0.13, 0.15), random->uniform(0.12, 0.14)};
  const double top = bottom + heights[0] + heights[1] + heights[2];
  const double x0 = -width / 2, x1 = width / 2;

  const int still = random->uniform(0, kDrawers);
  double z = bottom;
  int moving = 0;
  for (int i = 0; i < kDrawers; ++i) {
    const Slot slot{x0, x1, z, z + heights[i]};
    if (i == still)
      builder.addFixedFront("drawer_still", slot, Handle::kHorizontal);
    else
      builder.addDrawer("drawer_" + std::to_string(++moving), slot, random->uniform(0.26, 0.33));
    z = slot.z1;
  }
  builder.addCarcass({x0, x1, bottom, top}, depth);
  builder.addFixedBox({x0, 0, top + 0.003}, {x1, depth, top + 0.025}, materials.body);
  for (const double x : {x0 + 0.05, x1 - 0.05})
    for (const double y : {0.07, depth - 0.05}) builder.addFixedBox({x - 0.02, y - 0.02, 0}, {x + 0.02, y + 0.02, bottom}, 0.05);
  addRoom(materials, &builder);

  scene.view_target = {0.0, -0.1, (bottom + top) / 2 + 0.02};
  const double side = random->uniform(0, 2) == 0 ? -1 : 1;
  scene.view_point = viewPoint(scene.view_target, random->uniform(1.2, 1.35), side * radians(random->uniform(15, 30)),
                               radians(random->uniform(27, 33)));
  scene.shoulder = scene.view_target + Vector3d(-0.1 * side, -0.50, 1.0);
  return scene;
}

}  // namespace cabinet_articulation::core
