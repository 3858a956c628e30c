// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {

/// fromMessage for every element; an error says which element it was.
template <class Core, class Message>
std::vector<Core> fromMessages(const std::vector<Message>& messages, const std::string& name) {
  std::vector<Core> result;
  result.reserve(messages.size());
  for (const Message& message : messages) {
    try {
      result.push_back(fromMessage(message));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name + "[" + std::to_string(result.size()) + "]: " + error.what());
    }
  }
  return result;
}

}  // namespace cabinet_articulation
