// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <stdexcept>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace cabinet_articulation::core {

/// A setting is unknown, has the wrong type or lies outside its range. The message names key, value and what is allowed.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Allowed values of a number, both ends included.
struct Range {
  double min;
  double max;
};

/// Allowed values of a string.
using Choices = std::vector<std::string>;

/// A heading in the list of fields, above those that follow.
struct Section {
  const char* title;
};

/// Settings as they come from a YAML file or the parameter server, before they are checked.
using ConfigValue = std::variant<bool, int, double, std::string>;
using ConfigValues = std::map<std::string, ConfigValue>;

/*
 * A configuration is an aggregate whose fields all have initialisers (the only home of the defaults) and a static member
 *
 *   template <class Self, class Visitor>
 *   static void fields(Self& self, Visitor&& visit) {
 *     visit("stride", self.stride, Range{1, 32}, "px", "what it does and where the value comes from");
 *     visit("refine", self.refine, "what it does");                              // bool
 *     visit("method", self.method, Choices{"a", "b"}, "what it does");           // std::string
 *     visit(Section{"heading"});                                                 // above the fields that follow
 *   }
 *
 * Checking, loading, printing and the documentation's tables all follow from that one list.
 */

namespace detail {

std::string describe(const ConfigValue& value);
std::string nearestKey(const std::string& key, const std::vector<std::string>& keys);
void checkRange(const std::string& key, double value, const Range& range, const std::string& unit);
void checkChoice(const std::string& key, const std::string& value, const Choices& choices);
bool toBool(const std::string& key, const ConfigValue& value);
int toInt(const std::string& key, const ConfigValue& value);
double toDouble(const std::string& key, const ConfigValue& value);
std::string toString(const std::string& key, const ConfigValue& value);
std::string yamlNumber(double value);

/// For visitors that care for the fields only.
struct PassesOverSections {
  void operator()(const Section&) const {}
};

struct Checker : PassesOverSections {
  using PassesOverSections::operator();
  void operator()(const char*, const bool&, const char*) const {}
  template <class Number>
  void operator()(const char* key, const Number& value, const Range& range, const char* unit, const char*) const {
    checkRange(key, value, range, unit);
  }
  void operator()(const char* key, const std::string& value, const Choices& choices, const char*) const {
    checkChoice(key, value, choices);
  }
};

struct KeyLister : PassesOverSections {
  std::vector<std::string>* keys;

  explicit KeyLister(std::vector<std::string>* list) : keys(list) {}
  using PassesOverSections::operator();
  template <class... Rest>
  void operator()(const char* key, Rest&&...) const {
    keys->push_back(key);
  }
};

struct Assigner : PassesOverSections {
  const ConfigValues& values;

  explicit Assigner(const ConfigValues& all) : values(all) {}
  using PassesOverSections::operator();
  void operator()(const char* key, bool& field, const char*) const {
    if (const ConfigValue* value = find(key)) field = toBool(key, *value);
  }
  void operator()(const char* key, int& field, const Range&, const char*, const char*) const {
    if (const ConfigValue* value = find(key)) field = toInt(key, *value);
  }
  void operator()(const char* key, double& field, const Range&, const char*, const char*) const {
    if (const ConfigValue* value = find(key)) field = toDouble(key, *value);
  }
  void operator()(const char* key, std::string& field, const Choices&, const char*) const {
    if (const ConfigValue* value = find(key)) field = toString(key, *value);
  }
  const ConfigValue* find(const char* key) const {
    const auto it = values.find(key);
    return it == values.end() ? nullptr : &it->second;
  }
};

/// One line of a YAML file or of a documentation table.
struct FieldText {
  std::string key, value, unit, allowed, meaning;
  std::string section;  ///< heading above this field; empty: none
};

struct Describer {
  std::vector<FieldText>* out;
  std::string section;

  explicit Describer(std::vector<FieldText>* texts) : out(texts) {}
  void operator()(const Section& heading) { section = heading.title; }
  void operator()(const char* key, const bool& value, const char* meaning) {
    add({key, value ? "true" : "false", "", "true or false", meaning, ""});
  }
  template <class Number>
  void operator()(const char* key, const Number& value, const Range& range, const char* unit, const char* meaning) {
    const std::string text = std::is_integral<Number>::value ? std::to_string(static_cast<int>(value)) : yamlNumber(value);
    add({key, text, unit, yamlNumber(range.min) + " to " + yamlNumber(range.max), meaning, ""});
  }
  void operator()(const char* key, const std::string& value, const Choices& choices, const char* meaning) {
    std::string allowed;
    for (const std::string& choice : choices) allowed += (allowed.empty() ? "" : ", ") + choice;
    add({key, value.empty() ? "\"\"" : value, "", allowed, meaning, ""});
  }
  void add(FieldText text) {
    text.section.swap(section);
    out->push_back(std::move(text));
  }
};

std::string formatYaml(const std::string& title, const std::string& values, const std::vector<FieldText>& fields);

}  // namespace detail

/// Throws ConfigError if a field is outside its range. Every stage calls it on construction.
template <class Config>
void checkConfig(const Config& config) {
  Config::fields(config, detail::Checker{});
}

template <class Config>
std::vector<detail::FieldText> describeConfig(const Config& config) {
  std::vector<detail::FieldText> out;
  Config::fields(config, detail::Describer(&out));
  return out;
}

/// A complete YAML file with every field, its unit, range and meaning. `values` says where its values come from.
template <class Config>
std::string toYaml(const Config& config, const std::string& title, const std::string& values = "its default") {
  return detail::formatYaml(title, values, describeConfig(config));
}

/// Sets the fields that `values` names and checks the result. Returns a warning for each key that no configuration
/// knows (with the nearest known key). Throws ConfigError for a wrong type or a value out of range; nothing is half set.
template <class... Configs>
std::vector<std::string> applyConfig(const ConfigValues& values, Configs&... configs) {
  std::vector<std::string> keys;
  (Configs::fields(configs, detail::KeyLister(&keys)), ...);
  std::vector<std::string> warnings;
  for (const auto& entry : values) {
    bool known = false;
    for (const std::string& key : keys) known = known || key == entry.first;
    if (!known)
      warnings.push_back("unknown setting '" + entry.first + "' is ignored; did you mean '" +
                         detail::nearestKey(entry.first, keys) + "'?");
  }
  const auto assign = [&values](auto config) {
    decltype(config)::fields(config, detail::Assigner(values));
    checkConfig(config);
    return config;
  };
  std::tuple<Configs...> results(assign(configs)...);
  std::tie(configs...) = results;
  return warnings;
}

/// Reads a flat YAML mapping. Throws ConfigError naming the file and what is wrong (missing, no ordinary file, larger than 1 MB,
/// not a mapping, nested).
ConfigValues readYamlFile(const std::string& path);

/// Reads `path` over the defaults. Warnings about unknown keys are appended, with the file's name.
template <class Config>
Config loadConfig(const std::string& path, std::vector<std::string>* warnings) {
  Config config;
  try {
    for (const std::string& warning : applyConfig(readYamlFile(path), config)) warnings->push_back(path + ": " + warning);
  } catch (const ConfigError& error) {
    const std::string text = error.what();
    throw ConfigError(text.find(path) == std::string::npos ? path + ": " + text : text);
  }
  return config;
}

}  // namespace cabinet_articulation::core
