// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/original_params.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation::bridge {
namespace {

template <class List>
auto find(List& params, const std::string& name) {
  return std::find_if(params.begin(), params.end(), [&](const auto& param) { return param.name == name; });
}

double valueOf(const articulation_msgs::ParamMsg& param) {
  if (!std::isfinite(param.value)) throw std::invalid_argument("param '" + param.name + "' is not finite");
  return param.value;
}

}  // namespace

double paramOr(const Params& params, const std::string& name, double otherwise) {
  const auto found = find(params, name);
  return found == params.end() ? otherwise : valueOf(*found);
}

double requireParam(const Params& params, const std::string& name) {
  const auto found = find(params, name);
  if (found == params.end()) throw std::invalid_argument("param '" + name + "' is missing");
  return valueOf(*found);
}

Eigen::Vector3d requireVector(const Params& params, const std::string& name) {
  const double x = requireParam(params, name + ".x"), y = requireParam(params, name + ".y"),
               z = requireParam(params, name + ".z");
  core::requireWithin(name.c_str(), Eigen::Vector3d(x, y, z), core::limits::kFromOrigin);
  return {x, y, z};
}

Eigen::Quaterniond requireQuaternion(const Params& params, const std::string& name) {
  const double x = requireParam(params, name + ".x"), y = requireParam(params, name + ".y"),
               z = requireParam(params, name + ".z");
  const Eigen::Quaterniond value(requireParam(params, name + ".w"), x, y, z);
  constexpr double kShortest = 0.5, kLongest = 2;  // ours: what rounding and small steps make of unit length
  if (!(value.norm() >= kShortest && value.norm() <= kLongest))
    throw std::invalid_argument("param '" + name + "' is no quaternion of unit length");
  return value.normalized();
}

void setParam(const std::string& name, double value, int type, Params* params) {
  const auto found = find(*params, name);
  if (found != params->end()) {
    found->value = value;
    return;
  }
  params->emplace_back();
  params->back().name = name;
  params->back().value = value;
  params->back().type = static_cast<std::uint8_t>(type);
}

void setParam(const std::string& name, const Eigen::Vector3d& value, int type, Params* params) {
  setParam(name + ".x", value.x(), type, params);
  setParam(name + ".y", value.y(), type, params);
  setParam(name + ".z", value.z(), type, params);
}

void setParam(const std::string& name, const Eigen::Quaterniond& value, int type, Params* params) {
  setParam(name, Eigen::Vector3d(value.vec()), type, params);
  setParam(name + ".w", value.w(), type, params);
}

}  // namespace cabinet_articulation::bridge
