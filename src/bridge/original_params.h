// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <articulation_msgs/ParamMsg.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace cabinet_articulation::bridge {

using Params = std::vector<articulation_msgs::ParamMsg>;

/// The value, or `otherwise`. Throws std::invalid_argument for one that is not finite, as all below.
double paramOr(const Params& params, const std::string& name, double otherwise);

/// Throws std::invalid_argument that names it if it is missing.
double requireParam(const Params& params, const std::string& name);

/// <name>.x .y .z; beyond limits::kFromOrigin is refused.
Eigen::Vector3d requireVector(const Params& params, const std::string& name);

/// <name>.x .y .z .w, of any length that is not nearly 0.
Eigen::Quaterniond requireQuaternion(const Params& params, const std::string& name);

/// Replaces the value, or adds it with its type.
void setParam(const std::string& name, double value, int type, Params* params);
void setParam(const std::string& name, const Eigen::Vector3d& value, int type, Params* params);
void setParam(const std::string& name, const Eigen::Quaterniond& value, int type, Params* params);

}  // namespace cabinet_articulation::bridge
