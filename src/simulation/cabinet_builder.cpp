// SPDX-License-Identifier: BSD-3-Clause
#include "simulation/cabinet_builder.h"

#include <algorithm>

namespace cabinet_articulation::core {
namespace {

using Eigen::Vector3d;

constexpr double kFrontThickness = 0.018;  // [m] usual furniture boards
constexpr double kBodyBoard = 0.016;       // [m]
constexpr double kDrawerBoard = 0.012;     // [m]
constexpr double kDrawerDepth = 0.45;      // [m]
constexpr double kHingeInset = 0.011;      // [m] the axis lies inside the front's edge, as with cup hinges
constexpr double kHandleBar = 0.012;       // [m]
constexpr double kHandleStandoff = 0.030;  // [m]

}  // namespace

Materials Materials::random(cv::RNG* random) {
  Materials materials;
  materials.front = random->uniform(0.5, 0.8);
  materials.body = random->uniform(0.45, 0.75);
  materials.handle = random->uniform(0.15, 0.45);
  materials.worktop = random->uniform(0.1, 0.3);
  materials.plinth = random->uniform(0.05, 0.12);
  materials.wall = random->uniform(0.5, 0.7);
  materials.floor = random->uniform(0.2, 0.4);
  return materials;
}

void CabinetBuilder::addFixedBox(const Vector3d& a, const Vector3d& b, double reflectance) {
  addBox(boxBetween(a, b), reflectance, carrier_, &scene_->surfaces);
}

void CabinetBuilder::addRoomPlane(const std::string& name, const Rectangle& rectangle, double reflectance) {
  scene_->surfaces.push_back({rectangle, reflectance, kFixedPart});
  scene_->fixed.push_back({name, rectangle});
}

Box CabinetBuilder::frontBox(const Slot& slot) const {
  return boxBetween({slot.x0 + gap_ / 2, 0, slot.z0 + gap_ / 2}, {slot.x1 - gap_ / 2, kFrontThickness, slot.z1 - gap_ / 2});
}

Vector3d CabinetBuilder::addHandle(const Vector3d& centre, bool vertical, double length, int part) {
  const Vector3d along = vertical ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d bar = centre - kHandleStandoff * Vector3d::UnitY();
  const Vector3d half = Vector3d::Constant(kHandleBar / 2);
  addBox(boxBetween(bar - along * length / 2 - half, bar + along * length / 2 + half), materials_.handle, part,
         &scene_->surfaces);
  for (const double side : {-0.4, 0.4}) {
    const Vector3d post = centre + along * side * length;
    addBox(boxBetween(post - 0.7 * half - kHandleStandoff * Vector3d::UnitY(), post + 0.7 * half), materials_.handle, part,
           &scene_->surfaces);
  }
  return bar;
}

Vector3d CabinetBuilder::addFrontWithHandle(const Slot& slot, Handle handle, int part) {
  addBox(frontBox(slot), materials_.front, part, &scene_->surfaces);
  constexpr double kFromEdge = 0.05;  // [m]
  const double width = slot.x1 - slot.x0;
  if (handle == Handle::kHorizontal) {
    const double z = std::max((slot.z0 + slot.z1) / 2, slot.z1 - 0.08);
    return addHandle({(slot.x0 + slot.x1) / 2, 0, z}, false, std::min(0.16, width / 2), part);
  }
  const double x = handle == Handle::kVerticalLeft ? slot.x0 + kFromEdge : slot.x1 - kFromEdge;
  return addHandle({x, 0, slot.z1 - 0.13}, true, 0.14, part);
}

void CabinetBuilder::addFixedFront(const std::string& name, const Slot& slot, Handle handle) {
  addFrontWithHandle(slot, handle, kFixedPart);
  scene_->fixed.push_back({name, frontOf(frontBox(slot))});
}

void CabinetBuilder::addDrawerBox(const Slot& slot, int part) {
  const double x0 = slot.x0 + 0.03, x1 = slot.x1 - 0.03;
  const double z0 = slot.z0 + 0.02, z1 = slot.z0 + 0.75 * (slot.z1 - slot.z0);
  const double y0 = kFrontThickness, y1 = y0 + kDrawerDepth;
  const auto add = [&](const Vector3d& a, const Vector3d& b) {
    addBox(boxBetween(a, b), materials_.body, part, &scene_->surfaces);
  };
  add({x0, y0, z0}, {x0 + kDrawerBoard, y1, z1});
  add({x1 - kDrawerBoard, y0, z0}, {x1, y1, z1});
  add({x0, y1 - kDrawerBoard, z0}, {x1, y1, z1});
  add({x0, y0, z0}, {x1, y1, z0 + 0.006});
}

Joint CabinetBuilder::jointOf(const std::string& name, JointType type, const Slot& slot) const {
  Joint joint;
  joint.name = name;
  joint.type = type;
  joint.front = frontOf(frontBox(slot));
  joint.axis_point = joint.front.center();
  joint.parent = carrier_;
  return joint;
}

void CabinetBuilder::addDrawer(const std::string& name, const Slot& slot, double travel, double inside) {
  Joint joint = jointOf(name, JointType::kPrismatic, slot);
  joint.axis = -Vector3d::UnitY();
  joint.q_max = travel;
  const std::size_t first = scene_->surfaces.size();
  joint.grip = addFrontWithHandle(slot, Handle::kHorizontal, nextPart());
  addDrawerBox(slot, nextPart());
  const Eigen::Translation3d inwards(0, inside, 0);
  for (std::size_t i = first; i < scene_->surfaces.size(); ++i)
    scene_->surfaces[i].rectangle.pose = inwards * scene_->surfaces[i].rectangle.pose;
  for (Vector3d* point : {&joint.grip, &joint.axis_point}) *point = inwards * *point;
  joint.front.pose = inwards * joint.front.pose;
  scene_->joints.push_back(joint);
}

void CabinetBuilder::addDoor(const std::string& name, const Slot& slot, bool hinge_left, double q_max) {
  Joint joint = jointOf(name, JointType::kRotational, slot);
  // Seen from above a door with its hinge on the left opens clockwise.
  const double side = hinge_left ? -1 : 1;
  joint.axis = side * Vector3d::UnitZ();
  joint.axis_point = joint.front.center() + Vector3d(side * (joint.front.width / 2 - kHingeInset), kHingeInset, 0);
  joint.q_max = q_max;
  joint.grip = addFrontWithHandle(slot, hinge_left ? Handle::kVerticalRight : Handle::kVerticalLeft, nextPart());
  scene_->joints.push_back(joint);
}

void CabinetBuilder::addSecondLeaf(const std::string& name, const Slot& slot, double q_max) {
  Joint joint = jointOf(name, JointType::kRotational, slot);
  joint.axis = Vector3d::UnitZ();
  joint.axis_point = joint.front.center() + Vector3d(-(joint.front.width + gap_) / 2, kFrontThickness, 0);
  joint.q_max = q_max;
  joint.turn = Turn::kWithPrevious;
  addBox(frontBox(slot), materials_.front, nextPart(), &scene_->surfaces);
  scene_->joints.push_back(joint);
}

void CabinetBuilder::addPushedFace(const std::string& name, const Slot& slot, const Slot& board, double travel,
                                   const Vector3d& grip) {
  Joint joint = jointOf(name, JointType::kPrismatic, slot);
  joint.axis = Vector3d::UnitX();
  joint.q_max = travel;
  joint.grip = grip;
  joint.turn = Turn::kAroundOthers;
  addBox(frontBox(board), materials_.front, nextPart(), &scene_->surfaces);
  scene_->joints.push_back(joint);
}

void CabinetBuilder::addWallAndFloor(double y) {
  Rectangle wall;
  wall.pose.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  wall.pose.translation() = Vector3d(0, y, 1.25);
  wall.width = 6;
  wall.height = 2.5;
  addRoomPlane("wall", wall, materials_.wall);
  Rectangle floor;
  floor.pose.translation() = Vector3d(0, y - 2, 0);
  floor.width = 6;
  floor.height = 4;
  addRoomPlane("floor", floor, materials_.floor);
}

void CabinetBuilder::addCarcass(const Slot& slot, double depth) {
  const double y0 = kFrontThickness + 0.001;
  const double body = materials_.body;
  addFixedBox({slot.x0, y0, slot.z0}, {slot.x0 + kBodyBoard, depth, slot.z1}, body);
  addFixedBox({slot.x1 - kBodyBoard, y0, slot.z0}, {slot.x1, depth, slot.z1}, body);
  addFixedBox({slot.x0, y0, slot.z0}, {slot.x1, depth, slot.z0 + kBodyBoard}, body);
  addFixedBox({slot.x0, y0, slot.z1 - kBodyBoard}, {slot.x1, depth, slot.z1}, body);
  addFixedBox({slot.x0, depth - kBodyBoard, slot.z0}, {slot.x1, depth, slot.z1}, body);
}

void CabinetBuilder::addShelf(const Slot& slot, double z, double depth) {
  addFixedBox({slot.x0 + kBodyBoard, 0.04, z}, {slot.x1 - kBodyBoard, depth, z + kBodyBoard}, materials_.body);
}

}  // namespace cabinet_articulation::core
