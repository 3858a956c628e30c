// SPDX-License-Identifier: BSD-3-Clause
#include "ros/settings/parameters.h"

namespace cabinet_articulation {

core::ConfigValues toConfigValues(XmlRpc::XmlRpcValue value, std::vector<std::string>* warnings) {
  if (value.getType() != XmlRpc::XmlRpcValue::TypeStruct)
    throw core::ConfigError("expected a group of settings, found a single value");
  core::ConfigValues values;
  for (auto& entry : value) {
    XmlRpc::XmlRpcValue& setting = entry.second;
    switch (setting.getType()) {
      case XmlRpc::XmlRpcValue::TypeBoolean:
        values[entry.first] = static_cast<bool>(setting);
        break;
      case XmlRpc::XmlRpcValue::TypeInt:
        values[entry.first] = static_cast<int>(setting);
        break;
      case XmlRpc::XmlRpcValue::TypeDouble:
        values[entry.first] = static_cast<double>(setting);
        break;
      case XmlRpc::XmlRpcValue::TypeString:
        values[entry.first] = static_cast<std::string>(setting);
        break;
      default:
        warnings->push_back("setting '" + entry.first + "' is a list or a group and is ignored; expected a single value");
    }
  }
  return values;
}

core::ConfigValues readParameters(const ros::NodeHandle& nh, std::vector<std::string>* warnings) {
  XmlRpc::XmlRpcValue value;
  if (!nh.getParam(nh.getNamespace(), value)) return {};
  try {
    return toConfigValues(value, warnings);
  } catch (const core::ConfigError& error) {
    throw core::ConfigError(nh.getNamespace() + ": " + error.what());
  }
}

}  // namespace cabinet_articulation
