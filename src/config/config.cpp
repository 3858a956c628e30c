// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/config/config.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <sstream>

#include "config/ordinary_file.h"

namespace cabinet_articulation::core {
namespace detail {

namespace {

constexpr std::size_t kLargestFile = 1U << 20U;  // [bytes] our longest is 20 kB, and all its settings are read at once

size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substitution = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitution});
    }
  }
  return row.back();
}

[[noreturn]] void wrongType(const std::string& key, const ConfigValue& value, const std::string& expected) {
  throw ConfigError("setting '" + key + "' is " + describe(value) + ", expected " + expected);
}

}  // namespace

std::string yamlNumber(double value) {
  std::string text;
  for (int digits = 1; digits <= 17; ++digits) {
    std::ostringstream stream;
    stream.precision(digits);
    stream << value;
    text = stream.str();
    // 20 rather than 2e+01; the exponent stays for what is really large or small.
    const bool needless_exponent = text.find('e') != std::string::npos && std::abs(value) >= 1e-4 && std::abs(value) < 1e15;
    // std::stod would throw for the smallest numbers.
    if (std::strtod(text.c_str(), nullptr) == value && !needless_exponent) break;
  }
  // YAML 1.1, which roslaunch reads, takes 1e-05 for a text and 1.0e-05 for a number.
  const size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

std::string describe(const ConfigValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const int* number = std::get_if<int>(&value)) return std::to_string(*number);
  if (const double* number = std::get_if<double>(&value)) return std::isfinite(*number) ? yamlNumber(*number) : "not finite";
  return "'" + std::get<std::string>(value) + "'";
}

std::string nearestKey(const std::string& key, const std::vector<std::string>& keys) {
  const auto nearer = [&key](const std::string& a, const std::string& b) { return editDistance(key, a) < editDistance(key, b); };
  return keys.empty() ? "" : *std::min_element(keys.begin(), keys.end(), nearer);
}

void checkRange(const std::string& key, double value, const Range& range, const std::string& unit) {
  if (value >= range.min && value <= range.max) return;
  const std::string suffix = unit.empty() ? "" : " " + unit;
  throw ConfigError("setting '" + key + "' is " + describe(value) + suffix + ", allowed is " + yamlNumber(range.min) + " to " +
                    yamlNumber(range.max) + suffix);
}

void checkChoice(const std::string& key, const std::string& value, const Choices& choices) {
  if (choices.empty() || std::find(choices.begin(), choices.end(), value) != choices.end()) return;
  std::string allowed;
  for (const std::string& choice : choices) allowed += (allowed.empty() ? "'" : ", '") + choice + "'";
  throw ConfigError("setting '" + key + "' is '" + value + "', allowed is one of " + allowed);
}

bool toBool(const std::string& key, const ConfigValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag;
  wrongType(key, value, "true or false");
}

int toInt(const std::string& key, const ConfigValue& value) {
  if (const int* number = std::get_if<int>(&value)) return *number;
  wrongType(key, value, "a whole number");
}

double toDouble(const std::string& key, const ConfigValue& value) {
  if (const double* number = std::get_if<double>(&value)) return *number;
  if (const int* number = std::get_if<int>(&value)) return *number;
  wrongType(key, value, "a number");
}

std::string toString(const std::string& key, const ConfigValue& value) {
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  wrongType(key, value, "a text");
}

std::string formatYaml(const std::string& title, const std::string& values, const std::vector<FieldText>& fields) {
  std::string text = "# " + title + "\n# Every setting with " + values;
  text += ". Generated from the code: print_config prints it again.\n";
  for (const FieldText& field : fields) {
    if (!field.section.empty()) text += "\n# ---- " + field.section + "\n";
    text += "\n# " + field.meaning + "\n# ";
    if (!field.unit.empty()) text += "[" + field.unit + "] ";
    text += (field.allowed.empty() ? "any text" : field.allowed) + "\n" + field.key + ": " + field.value + "\n";
  }
  return text;
}

namespace {

template <class Number>
bool parse(const std::string& text, Number* number) {
  std::istringstream stream(text);
  return (stream >> *number) && stream.eof();
}

ConfigValue scalar(const YAML::Node& node) {
  const std::string text = node.Scalar();
  const bool quoted = node.Tag() == "!";
  int whole = 0;
  double real = 0;
  if (!quoted && (text == "true" || text == "false")) return text == "true";
  if (!quoted && parse(text, &whole)) return whole;
  if (!quoted && parse(text, &real)) return real;
  if (!quoted && (text == ".nan" || text == ".inf" || text == "-.inf")) return node.as<double>();
  return text;
}

/// Throws ConfigError.
std::string configurationText(const std::string& path) {
  try {
    return readOrdinaryFile(path, kLargestFile);
  } catch (const std::runtime_error& error) {
    throw ConfigError("configuration file '" + path + "' " + error.what());
  }
}

}  // namespace
}  // namespace detail

ConfigValues readYamlFile(const std::string& path) {
  ConfigValues values;
  try {
    const YAML::Node root = YAML::Load(detail::configurationText(path));
    if (root.IsNull()) return values;
    if (!root.IsMap()) throw ConfigError(path + ": expected 'setting: value' lines");
    for (const auto& entry : root) {
      if (!entry.second.IsScalar())
        throw ConfigError(path + ": setting '" + entry.first.Scalar() +
                          "' is not a single value, expected a number, true, false or a text");
      values[entry.first.Scalar()] = detail::scalar(entry.second);
    }
  } catch (const YAML::Exception& error) {
    throw ConfigError(path + ": " + error.what());
  }
  return values;
}

}  // namespace cabinet_articulation::core
