// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "simulation/cabinet_scenes.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kSkin = 0.55;
constexpr double kSleeve = 0.4;
constexpr int kSides = 8;

/// A piece of the arm between two distances from the grip, with an elliptic cross-section.
struct Limb {
  double near, far;           ///< [m]
  double radius_x, radius_y;  ///< [m]
  double reflectance;
};

/// A prism, round enough that nobody takes its sides for a front, closed towards the grip. The arm runs along z.
void addLimb(const Eigen::Isometry3d& arm, const Limb& limb, std::vector<Surface>* surfaces) {
  const auto corner = [&limb](double k) {
    const double angle = (k + 0.5) * 2 * EIGEN_PI / kSides;
    return Eigen::Vector3d(limb.radius_x * std::cos(angle), limb.radius_y * std::sin(angle), (limb.near + limb.far) / 2);
  };
  for (int k = 0; k < kSides; ++k) {
    const Eigen::Vector3d along = (corner(k + 1) - corner(k)).normalized();
    Rectangle side;
    side.pose.linear() << along, Eigen::Vector3d::UnitZ(), along.cross(Eigen::Vector3d::UnitZ());
    side.pose.translation() = (corner(k) + corner(k + 1)) / 2;
    side.pose = arm * side.pose;
    side.width = (corner(k + 1) - corner(k)).norm();
    side.height = limb.far - limb.near;
    surfaces->push_back({side, limb.reflectance, kFixedPart});
  }
  // Three rectangles cover an octagon but for slivers.
  const double cosine = std::cos(EIGEN_PI / kSides), sine = std::sin(EIGEN_PI / kSides), middle = (cosine + sine) / 2;
  for (const auto& share : {Eigen::Vector2d(cosine, sine), Eigen::Vector2d(sine, cosine), Eigen::Vector2d(middle, middle)}) {
    Rectangle cap;
    cap.pose = arm * Eigen::Translation3d(0, 0, limb.near) * Eigen::AngleAxisd(EIGEN_PI, Eigen::Vector3d::UnitX());
    cap.width = 2 * limb.radius_x * share.x();
    cap.height = 2 * limb.radius_y * share.y();
    surfaces->push_back({cap, limb.reflectance, kFixedPart});
  }
}

}  // namespace

std::vector<Surface> makeArm(const Eigen::Vector3d& grip, const Eigen::Vector3d& shoulder) {
  Eigen::Isometry3d arm = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d z = (shoulder - grip).normalized();
  const Eigen::Vector3d x = z.cross(Eigen::Vector3d::UnitZ()).normalized();
  arm.linear() << x, z.cross(x), z;
  arm.translation() = grip;
  std::vector<Surface> surfaces;
  const Limb hand{-0.015, 0.085, 0.042, 0.024, kSkin}, wrist{0.085, 0.17, 0.030, 0.025, kSkin};
  const Limb forearm{0.17, 0.40, 0.043, 0.043, kSleeve}, upper_arm{0.40, 0.70, 0.053, 0.053, kSleeve};
  for (const Limb& limb : {hand, wrist, forearm, upper_arm}) addLimb(arm, limb, &surfaces);
  return surfaces;
}

}  // namespace cabinet_articulation::core
