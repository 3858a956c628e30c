// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "cabinet_articulation/simulation/scene.h"

namespace cabinet_articulation::core {

/// Reflectances.
struct Materials {
  double front, body, handle, worktop, plinth, wall, floor;

  static Materials random(cv::RNG* random);
};

/// The place of one front in y = 0, up to the middle of the gaps around it. [m]
struct Slot {
  double x0, x1, z0, z1;
};

enum class Handle { kHorizontal, kVerticalLeft, kVerticalRight };

/// Adds pieces of furniture to a scene.
class CabinetBuilder {
 public:
  CabinetBuilder(Scene* scene, const Materials& materials, double gap) : scene_(scene), materials_(materials), gap_(gap) {}

  /// What is added from here on is carried by the joint that was added last.
  void hangOnLastJoint() { carrier_ = nextPart() - 1; }

  /// The joint that was added last is closed when those that are added later are.
  void keepLastJointOpen() { scene_->joints.back().turn = Turn::kAroundOthers; }

  void addFixedFront(const std::string& name, const Slot& slot, Handle handle);
  /// `inside` [m]: how far its closed front lies behind those of y = 0.
  void addDrawer(const std::string& name, const Slot& slot, double travel, double inside = 0);
  void addDoor(const std::string& name, const Slot& slot, bool hinge_left, double q_max);

  /// The second leaf of a folding door, to the right of the one it hangs on. Their backs come together as it opens.
  void addSecondLeaf(const std::string& name, const Slot& slot, double q_max);

  /// The face of something that is pushed along x, and held at `grip`. Fronts that hang on it may fill a part of it; its own
  /// board is in `board`.
  void addPushedFace(const std::string& name, const Slot& slot, const Slot& board, double travel, const Eigen::Vector3d& grip);

  /// Side boards, bottom, top rail and back behind the slot, so that one looks into something when a front is open.
  void addCarcass(const Slot& slot, double depth);
  void addShelf(const Slot& slot, double z, double depth);

  /// Carried as all else, by the room if by nothing.
  void addFixedBox(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double reflectance);

  /// A large static rectangle of the room, listed in the ground truth.
  void addRoomPlane(const std::string& name, const Rectangle& rectangle, double reflectance);

  /// A wall `y` behind the fronts, and the floor before it.
  void addWallAndFloor(double y);

 private:
  Box frontBox(const Slot& slot) const;
  /// Returns where a hand holds the handle.
  Eigen::Vector3d addFrontWithHandle(const Slot& slot, Handle handle, int part);
  Eigen::Vector3d addHandle(const Eigen::Vector3d& centre, bool vertical, double length, int part);
  void addDrawerBox(const Slot& slot, int part);
  int nextPart() const { return static_cast<int>(scene_->joints.size()); }
  Joint jointOf(const std::string& name, JointType type, const Slot& slot) const;

  Scene* scene_;
  Materials materials_;
  double gap_;
  int carrier_ = kFixedPart;
};

}  // namespace cabinet_articulation::core
