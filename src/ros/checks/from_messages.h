// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {

/// Every element of a list of fronts, planes or poses, converted; an error says which element it was.
template <class Core, class Message, class Convert>
std::vector<Core> convertAll(const std::vector<Message>& messages, const std::string& name, std::size_t most,
                             const Convert& convert) {
  core::requireAtMost(name.c_str(), messages.size(), most);
  std::vector<Core> result;
  result.reserve(messages.size());
  for (const Message& message : messages) {
    try {
      result.push_back(convert(message));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name + "[" + std::to_string(result.size()) + "]: " + error.what());
    }
  }
  return result;
}

template <class Core, class Message>
std::vector<Core> fromMessages(const std::vector<Message>& messages, const std::string& name, std::size_t most) {
  return convertAll<Core>(messages, name, most, [](const Message& message) { return fromMessage(message); });
}

/// As convertAll, but without what cannot be used; `left_out` names one that cannot, and why.
template <class Core, class Message, class Convert>
std::vector<Core> convertUsable(const std::vector<Message>& messages, const std::string& name, std::size_t most,
                                const Convert& convert, std::string* left_out) {
  std::vector<Core> result;
  for (std::size_t i = 0; i < messages.size(); ++i) {
    try {
      core::requireAtMost(name.c_str(), i + 1, most);
      result.push_back(convert(messages[i]));
    } catch (const std::invalid_argument& error) {
      *left_out = name + "[" + std::to_string(i) + "]: " + error.what();
    }
  }
  return result;
}

}  // namespace cabinet_articulation
