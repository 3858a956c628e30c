// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/ros.h>

#include <functional>
#include <mutex>
#include <string>

#include "cabinet_articulation/config/config.h"
#include "ros/checks/callback_guard.h"

namespace cabinet_articulation {

/*
 * Settings that rqt_reconfigure can change while a stage runs. What it offers follows from the configuration's list of fields, so
 * that defaults, ranges and meanings have one home. Hence no .cfg file and no generated server.
 */

namespace detail {

/// A field as dynamic_reconfigure describes it. Called by `fields()`.
class DescriptionBuilder : public core::detail::PassesOverSections {
 public:
  DescriptionBuilder();

  using PassesOverSections::operator();

  void operator()(const char* key, const bool& value, const char* meaning);
  void operator()(const char* key, const int& value, const core::Range& range, const char* unit, const char* meaning);
  void operator()(const char* key, const double& value, const core::Range& range, const char* unit, const char* meaning);
  void operator()(const char* key, const std::string& value, const core::Choices& choices, const char* meaning);

  dynamic_reconfigure::ConfigDescription description;

 private:
  void addParameter(const std::string& key, const std::string& type, const std::string& meaning, const std::string& edit_method);
};

/// The values of the fields. Called by `fields()`.
struct ValueCollector : core::detail::PassesOverSections {
  dynamic_reconfigure::Config* values;

  explicit ValueCollector(dynamic_reconfigure::Config* all) : values(all) {}
  using PassesOverSections::operator();

  void operator()(const char* key, const bool& value, const char*) const;
  void operator()(const char* key, const int& value, const core::Range&, const char*, const char*) const;
  void operator()(const char* key, const double& value, const core::Range&, const char*, const char*) const;
  void operator()(const char* key, const std::string& value, const core::Choices&, const char*) const;
};

}  // namespace detail

template <class Config>
dynamic_reconfigure::ConfigDescription describeForTuning() {
  const Config defaults;
  detail::DescriptionBuilder builder;
  Config::fields(defaults, builder);
  return builder.description;
}

template <class Config>
dynamic_reconfigure::Config toTuning(const Config& config) {
  dynamic_reconfigure::Config values;
  Config::fields(config, detail::ValueCollector(&values));
  dynamic_reconfigure::GroupState group;
  group.name = "Default";
  group.state = true;
  values.groups.push_back(group);
  return values;
}

core::ConfigValues fromTuning(const dynamic_reconfigure::Config& values);

/// The ROS side: `set_parameters`, `parameter_descriptions` and `parameter_updates` in a private namespace.
class LiveSettings {
 public:
  /// Applies new values and returns those that are in force then. May throw ConfigError: nothing changes, the caller of
  /// set_parameters sees the old values, and the guard hears why.
  using Apply = std::function<dynamic_reconfigure::Config(const core::ConfigValues&)>;

  LiveSettings(const ros::NodeHandle& private_nh, const dynamic_reconfigure::ConfigDescription& description,
               const dynamic_reconfigure::Config& current, Apply apply, const CallbackGuard& guard);

  /// Waits for a call that is running.
  void shutdown();

 private:
  bool set(dynamic_reconfigure::Reconfigure::Request& request, dynamic_reconfigure::Reconfigure::Response& response);
  void publish();

  ros::NodeHandle nh_;
  Apply apply_;
  const CallbackGuard guard_;
  std::mutex mutex_;
  dynamic_reconfigure::Config current_;
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer server_;
};

}  // namespace cabinet_articulation
