// SPDX-License-Identifier: BSD-3-Clause
#include "joints/front_names.h"

#include <algorithm>
#include <charconv>

namespace cabinet_articulation::core {
namespace {

constexpr char kDefault[] = "front_";
constexpr char kFill = '_';

// Those of the locale would let letters pass that ROS refuses.
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool isFit(char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; }

std::string shortened(const std::string& name, std::size_t by) { return name.substr(0, kLongestName - by); }

/// One underscore for everything in a row that does not fit.
std::string fitting(const std::string& wanted) {
  std::string name;
  for (const char c : wanted)
    if (isFit(c) || name.empty() || name.back() != kFill) name += isFit(c) ? c : kFill;
  name.erase(0, std::min(name.find_first_not_of(kFill), name.size()));
  name.erase(name.find_last_not_of(kFill) + 1);
  if (!name.empty() && !isLetter(name.front())) name.insert(0, kDefault);
  return shortened(name, 0);
}

}  // namespace

std::string defaultName(std::uint32_t id) { return kDefault + std::to_string(id); }

std::optional<std::uint32_t> ownerOfDefaultName(const std::string& name) {
  if (name.rfind(kDefault, 0) != 0) return std::nullopt;
  std::uint32_t id = 0;
  std::from_chars(name.data() + sizeof(kDefault) - 1, name.data() + name.size(), id);
  return name == defaultName(id) ? std::optional<std::uint32_t>(id) : std::nullopt;
}

std::string whyUnfit(const std::string& name) {
  if (name.empty()) return "the name is empty";
  if (name.size() > kLongestName)
    return "the name has " + std::to_string(name.size()) + " characters, expected " + std::to_string(kLongestName) + " at most";
  if (!isLetter(name.front())) return "the name does not begin with a letter from A to Z";
  const auto unfit = std::find_if_not(name.begin(), name.end(), isFit);
  if (unfit == name.end()) return "";
  return "the character at position " + std::to_string(unfit - name.begin() + 1) +
         " of the name is no letter from A to Z, digit or underscore";
}

std::string proposeName(const std::string& wanted, std::uint32_t id, const std::function<bool(const std::string&)>& is_free) {
  const std::string base = fitting(wanted).empty() ? defaultName(id) : fitting(wanted);
  std::string name = base;
  for (int number = 2; !is_free(name); ++number) {
    const std::string ending = kFill + std::to_string(number);
    name = shortened(base, ending.size()) + ending;
  }
  return name;
}

}  // namespace cabinet_articulation::core
