// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/geometry/joint_type.h"
#include "cabinet_articulation/geometry/rectangle.h"

namespace cabinet_articulation::core {

constexpr int kFixedPart = -1;

/// A matt rectangle, seen from the side its normal points to.
struct Surface {
  Rectangle rectangle;
  double reflectance = 0.5;
  int part = kFixedPart;  ///< index of the joint that carries it
};

/// When a joint moves in a scene's script.
enum class Turn {
  kAlone,         ///< opens and closes after the joints before it
  kWithPrevious,  ///< together with the joint before it
  kAroundOthers   ///< stays open until the joints after it are done
};

/// One front that can move. Everything in the world frame and closed (q = 0), that of what carries it included.
struct Joint {
  std::string name;
  JointType type = JointType::kRigid;
  Rectangle front;                                       ///< x along the width, y up, z outward
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();       ///< as ArticulationModel.axis
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();  ///< the axis' point nearest to the front's centre
  double q_max = 0;                                      ///< [m or rad]
  Eigen::Vector3d grip = Eigen::Vector3d::Zero();        ///< where a hand holds it
  int parent = kFixedPart;                               ///< index of the joint that carries it, which comes before it
  Turn turn = Turn::kAlone;

  /// Eq. (8): moves what is attached to the joint from closed to q, in the world frame, while what carries it is closed.
  Eigen::Isometry3d motion(double q) const;
};

struct FixedFront {
  std::string name;
  Rectangle rectangle;
};

/// Planar surfaces, what moves them, and the place to look from. World frame: x along the wall to the right, y into the
/// wall, z up from the floor; closed fronts lie in y = 0 and face -y.
struct Scene {
  std::string name;
  std::vector<Surface> surfaces;
  std::vector<Joint> joints;
  std::vector<FixedFront> fixed;
  Eigen::Vector3d view_point = Eigen::Vector3d(0, -1.3, 1);  ///< the left camera's centre at rest
  Eigen::Vector3d view_target = Eigen::Vector3d(0, 0, 0.5);  ///< what the camera looks at
  Eigen::Vector3d shoulder = Eigen::Vector3d(0.5, -1, 1.3);  ///< of the person whose hand moves the fronts

  /// How each joint moves what is attached to it from closed to `q` (one value per joint), in the world frame.
  std::vector<Eigen::Isometry3d> motionsAt(const std::vector<double>& q) const;

  /// All surfaces in the world frame with the joints at `q`.
  std::vector<Surface> surfacesAt(const std::vector<double>& q) const;
};

/// A box: `pose` places its centre, `size` are the full sides along its axes.
struct Box {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  Eigen::Vector3d size = Eigen::Vector3d::Ones();
};

/// The box between two corners, sides along the axes of the frame.
Box boxBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

/// The box's side that faces -y, as a front.
Rectangle frontOf(const Box& box);

/// Six outward surfaces.
void addBox(const Box& box, double reflectance, int part, std::vector<Surface>* surfaces);

/// Pose of an optical frame (x right, y down, z forward) at `eye` that looks at `target`, x horizontal.
Eigen::Isometry3d lookAt(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

}  // namespace cabinet_articulation::core
