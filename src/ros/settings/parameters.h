// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <string>
#include <vector>

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation {

/// The settings in a parameter namespace. A list or a group is not a setting: it is left out with a warning.
/// Throws ConfigError if `value` is not a namespace at all.
core::ConfigValues toConfigValues(XmlRpc::XmlRpcValue value, std::vector<std::string>* warnings);

/// Everything set in the namespace of `nh`; nothing if the namespace does not exist. Errors name the namespace.
core::ConfigValues readParameters(const ros::NodeHandle& nh, std::vector<std::string>* warnings);

/// Fills the configurations from the namespace of `nh`. Returns warnings, one for each key that no configuration knows.
/// Throws ConfigError naming parameter, value and range; then nothing is changed.
template <class... Configs>
std::vector<std::string> loadParameters(const ros::NodeHandle& nh, Configs&... configs) {
  std::vector<std::string> warnings;
  const core::ConfigValues values = readParameters(nh, &warnings);
  try {
    for (const std::string& warning : core::applyConfig(values, configs...)) warnings.push_back(warning);
  } catch (const core::ConfigError& error) {
    throw core::ConfigError(nh.getNamespace() + ": " + error.what());
  }
  return warnings;
}

}  // namespace cabinet_articulation
