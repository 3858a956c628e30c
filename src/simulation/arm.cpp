// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/simulation/cabinet_scenes.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kSkin = 0.55;
constexpr double kSleeve = 0.4;

/// A box along the arm from `near` to `far` [m] metres away from the grip.
Box segment(const Eigen::Isometry3d& arm, double near, double far, double width, double thickness) {
  Box box;
  box.pose = arm * Eigen::Translation3d(0, 0, (near + far) / 2);
  box.size = {width, thickness, far - near};
  return box;
}

}  // namespace

std::vector<Surface> makeArm(const Eigen::Vector3d& grip, const Eigen::Vector3d& shoulder) {
  Eigen::Isometry3d arm = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d z = (shoulder - grip).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  arm.linear() << x, z.cross(x), z;
  arm.translation() = grip;
  std::vector<Surface> surfaces;
  addBox(segment(arm, -0.015, 0.085, 0.08, 0.04), kSkin, kFixedPart, &surfaces);  // hand
  addBox(segment(arm, 0.085, 0.17, 0.055, 0.045), kSkin, kFixedPart, &surfaces);  // wrist
  addBox(segment(arm, 0.17, 0.40, 0.08, 0.08), kSleeve, kFixedPart, &surfaces);   // forearm
  addBox(segment(arm, 0.40, 0.70, 0.1, 0.1), kSleeve, kFixedPart, &surfaces);     // upper arm
  return surfaces;
}

}  // namespace cabinet_articulation::core
