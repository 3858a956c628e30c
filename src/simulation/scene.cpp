// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/simulation/scene.h"

namespace cabinet_articulation::core {

Eigen::Isometry3d Joint::motion(double q) const {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  if (type == JointType::kPrismatic) motion.translation() = q * axis;
  if (type == JointType::kRotational)
    motion = Eigen::Translation3d(axis_point) * Eigen::AngleAxisd(q, axis) * Eigen::Translation3d(-axis_point);
  return motion;
}

std::vector<Eigen::Isometry3d> Scene::motionsAt(const std::vector<double>& q) const {
  std::vector<Eigen::Isometry3d> motions;
  for (size_t i = 0; i < joints.size(); ++i) {
    const Eigen::Isometry3d own = joints[i].motion(q[i]);
    motions.push_back(joints[i].parent == kFixedPart ? own : motions.at(static_cast<size_t>(joints[i].parent)) * own);
  }
  return motions;
}

std::vector<Surface> Scene::surfacesAt(const std::vector<double>& q) const {
  const std::vector<Eigen::Isometry3d> motions = motionsAt(q);
  std::vector<Surface> moved = surfaces;
  for (Surface& surface : moved)
    if (surface.part != kFixedPart) surface.rectangle.pose = motions[surface.part] * surface.rectangle.pose;
  return moved;
}

Box boxBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Box box;
  box.pose.translation() = (a + b) / 2;
  box.size = (b - a).cwiseAbs();
  return box;
}

Rectangle frontOf(const Box& box) {
  Rectangle front;
  front.pose.linear().col(0) = box.pose.linear().col(0);
  front.pose.linear().col(1) = box.pose.linear().col(2);
  front.pose.linear().col(2) = -box.pose.linear().col(1);
  front.pose.translation() = box.pose * Eigen::Vector3d(0, -box.size.y() / 2, 0);
  front.width = box.size.x();
  front.height = box.size.z();
  return front;
}

void addBox(const Box& box, double reflectance, int part, std::vector<Surface>* surfaces) {
  for (int axis = 0; axis < 3; ++axis) {
    const int x = (axis + 1) % 3;
    const int y = (axis + 2) % 3;
    for (const double side : {1.0, -1.0}) {
      Rectangle face;
      face.pose.linear().col(0) = side * box.pose.linear().col(x);
      face.pose.linear().col(1) = box.pose.linear().col(y);
      face.pose.linear().col(2) = side * box.pose.linear().col(axis);
      face.pose.translation() = box.pose.translation() + face.normal() * (box.size[axis] / 2);
      face.width = box.size[x];
      face.height = box.size[y];
      surfaces->push_back({face, reflectance, part});
    }
  }
}

Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const Eigen::Vector3d forward = (target - eye).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() << right, forward.cross(right), forward;
  pose.translation() = eye;
  return pose;
}

}  // namespace cabinet_articulation::core
