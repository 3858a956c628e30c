// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

namespace cabinet_articulation::core {

/**
 * Undoes the turns of a tracker that takes a square for another of its descriptions (ours). A marker or rectangle has eight
 * descriptions: by quarter turns about its normal, from the front or from the back. Where poses are given relative to a marker,
 * that marker may have made a quarter turn. It turns the pose about the frame's z. A pose is given the description that is near
 * the poses before, where its own is not. No front turns by an eighth of a turn about its normal from one pose to the next.
 */
class AmbiguousTurns {
 public:
  /// The pose becomes left * pose * right.
  struct Description {
    Eigen::Matrix3d left = Eigen::Matrix3d::Identity(), right = Eigen::Matrix3d::Identity();

    Eigen::Isometry3d operator()(const Eigen::Isometry3d& pose) const;
    /// Width and height change places.
    bool swapsSides() const { return std::abs(right(0, 0)) < 0.5; }
  };

  struct Resolved {
    Eigen::Isometry3d pose;
    bool swaps_sides = false;
  };

  /// `sigma_position` [m], `sigma_orientation` [rad]: noise of a pose.
  AmbiguousTurns(double sigma_position, double sigma_orientation)
      : sigma_position_(sigma_position), sigma_orientation_(sigma_orientation) {}

  /// The pose in the description of those before. The next pose follows this one.
  Resolved resolve(const Eigen::Isometry3d& pose);

  /// From the description of the first pose to the one that most of the poses came in.
  Description most() const;

  /// The poses are given another description: resolve() goes on in that one.
  void redescribe(const Description& description);

 private:
  static constexpr std::size_t kLefts = 4, kRights = 8;

  double cost(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;
  bool areNear(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;
  void follow(const Eigen::Isometry3d& pose);

  double sigma_position_, sigma_orientation_;
  std::optional<Eigen::Isometry3d> last_;
  Eigen::Isometry3d elsewhere_ = Eigen::Isometry3d::Identity();  ///< the newest pose that was not near the last one
  int far_ = 0;                                                  ///< such poses that were near one another
  std::array<int, kLefts * kRights> counts_{};
};

}  // namespace cabinet_articulation::core
