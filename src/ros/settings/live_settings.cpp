// SPDX-License-Identifier: BSD-3-Clause
#include "ros/settings/live_settings.h"

#include <stdexcept>
#include <utility>

namespace cabinet_articulation {
namespace detail {
namespace {

std::string withUnit(const std::string& meaning, const std::string& unit) {
  return unit.empty() ? meaning : meaning + " [" + unit + "]";
}

/// A Python dictionary, as rqt_reconfigure evaluates it.
std::string enumeration(const core::Choices& choices) {
  std::string text;
  for (const std::string& choice : choices)
    text += (text.empty() ? "" : ", ") + ("{'name': '" + choice + "', 'type': 'str', 'value': '" + choice +
                                          "', 'description': '', 'srcline': 0, 'srcfile': '', 'cconsttype': '', 'ctype': ''}");
  return text.empty() ? "" : "{'enum_description': '', 'enum': [" + text + "]}";
}

/// The same for every type: a name and a value.
template <class Value, class Parameters>
void addValue(const std::string& key, const Value& value, Parameters* parameters) {
  parameters->emplace_back();
  parameters->back().name = key;
  parameters->back().value = value;
}

}  // namespace

DescriptionBuilder::DescriptionBuilder() {
  description.groups.resize(1);
  description.groups[0].name = "Default";
}

void DescriptionBuilder::addParameter(const std::string& key, const std::string& type, const std::string& meaning,
                                      const std::string& edit_method) {
  dynamic_reconfigure::ParamDescription parameter;
  parameter.name = key;
  parameter.type = type;
  parameter.description = meaning;
  parameter.edit_method = edit_method;
  description.groups[0].parameters.push_back(parameter);
}

void DescriptionBuilder::operator()(const char* key, const bool& value, const char* meaning) {
  addParameter(key, "bool", meaning, "");
  addValue(key, value, &description.dflt.bools);
  addValue(key, false, &description.min.bools);
  addValue(key, true, &description.max.bools);
}

void DescriptionBuilder::operator()(const char* key, const int& value, const core::Range& range, const char* unit,
                                    const char* meaning) {
  addParameter(key, "int", withUnit(meaning, unit), "");
  addValue(key, value, &description.dflt.ints);
  addValue(key, static_cast<int>(range.min), &description.min.ints);
  addValue(key, static_cast<int>(range.max), &description.max.ints);
}

void DescriptionBuilder::operator()(const char* key, const double& value, const core::Range& range, const char* unit,
                                    const char* meaning) {
  addParameter(key, "double", withUnit(meaning, unit), "");
  addValue(key, value, &description.dflt.doubles);
  addValue(key, range.min, &description.min.doubles);
  addValue(key, range.max, &description.max.doubles);
}

void DescriptionBuilder::operator()(const char* key, const std::string& value, const core::Choices& choices,
                                    const char* meaning) {
  addParameter(key, "str", meaning, enumeration(choices));
  addValue(key, value, &description.dflt.strs);
  addValue(key, std::string(), &description.min.strs);
  addValue(key, std::string(), &description.max.strs);
}

void ValueCollector::operator()(const char* key, const bool& value, const char*) const { addValue(key, value, &values->bools); }

void ValueCollector::operator()(const char* key, const int& value, const core::Range&, const char*, const char*) const {
  addValue(key, value, &values->ints);
}

void ValueCollector::operator()(const char* key, const double& value, const core::Range&, const char*, const char*) const {
  addValue(key, value, &values->doubles);
}

void ValueCollector::operator()(const char* key, const std::string& value, const core::Choices&, const char*) const {
  addValue(key, value, &values->strs);
}

}  // namespace detail

core::ConfigValues fromTuning(const dynamic_reconfigure::Config& tuning) {
  core::ConfigValues values;
  for (const auto& parameter : tuning.bools) values[parameter.name] = static_cast<bool>(parameter.value);
  for (const auto& parameter : tuning.ints) values[parameter.name] = parameter.value;
  for (const auto& parameter : tuning.doubles) values[parameter.name] = parameter.value;
  for (const auto& parameter : tuning.strs) values[parameter.name] = parameter.value;
  return values;
}

LiveSettings::LiveSettings(const ros::NodeHandle& private_nh, const dynamic_reconfigure::ConfigDescription& description,
                           const dynamic_reconfigure::Config& current, Apply apply, const CallbackGuard& guard)
    : nh_(private_nh), apply_(std::move(apply)), guard_(guard), current_(current) {
  constexpr bool kLatched = true;
  descriptions_ = nh_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, kLatched);
  updates_ = nh_.advertise<dynamic_reconfigure::Config>("parameter_updates", 1, kLatched);
  descriptions_.publish(description);
  updates_.publish(current_);
  server_ = nh_.advertiseService("set_parameters", &LiveSettings::set, this);
}

void LiveSettings::shutdown() { server_.shutdown(); }

bool LiveSettings::set(dynamic_reconfigure::Reconfigure::Request& request, dynamic_reconfigure::Reconfigure::Response& response) {
  std::lock_guard<std::mutex> lock(mutex_);
  guard_("set_parameters", [&] {
    try {
      current_ = apply_(fromTuning(request.config));
    } catch (const std::exception& error) {
      throw std::runtime_error(error.what() + std::string("; nothing is changed"));
    }
    publish();
  });
  response.config = current_;
  return true;
}

/// The parameter server keeps what is in force, for `rosparam dump` and for the next start.
void LiveSettings::publish() {
  for (const auto& parameter : current_.bools) nh_.setParam(parameter.name, static_cast<bool>(parameter.value));
  for (const auto& parameter : current_.ints) nh_.setParam(parameter.name, parameter.value);
  for (const auto& parameter : current_.doubles) nh_.setParam(parameter.name, parameter.value);
  for (const auto& parameter : current_.strs) nh_.setParam(parameter.name, parameter.value);
  updates_.publish(current_);
}

}  // namespace cabinet_articulation
