// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "cabinet_articulation/geometry/joint_type.h"
#include "geometry/palette.h"

namespace cabinet_articulation::core {

/// What q counts.
enum class ConfigurationUnit : std::uint8_t { kMetre, kRadian };

/// The kinds of joints that URDF has for a front.
enum class UrdfJoint : std::uint8_t { kNone, kPrismatic, kRevolute };

/// What other code may ask of a type of joint, so that it need not know which types there are.
struct JointTraits {
  JointType type;
  const char* name;        ///< as in the original release, where there is one
  ConfigurationUnit unit;  ///< of q
  bool moves;              ///< has a latent configuration q
  /// Its shape is that of one kind of joint. One that is not follows any smooth motion, and is asked only when no joint explains
  /// a motion.
  bool is_parametric;
  bool turns;          ///< about the axis through LearnedModel::axis_point
  bool is_hinge;       ///< the axis lies in the front's plane, at one of its edges
  UrdfJoint urdf;      ///< kNone: URDF has no such joint
  palette::Rgb color;  ///< of what is drawn of it
};

}  // namespace cabinet_articulation::core
