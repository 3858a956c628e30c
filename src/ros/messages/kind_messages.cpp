// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/kind_messages.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation {
namespace {

Kind toMessage(const core::JointKind& kind) {
  const core::JointShape& mean = kind.mean();
  const bool turns = mean.turns();
  Kind message;
  message.type = static_cast<std::uint8_t>(mean.type);
  const Eigen::Vector3d axis = mean.frame.col(turns ? 2 : 0);
  message.axis.x = axis.x();
  message.axis.y = axis.y();
  message.axis.z = axis.z();
  message.range = kind.range();
  message.width = kind.sides().width();
  message.height = kind.sides().height();
  message.joints = static_cast<std::uint32_t>(kind.size());
  for (const core::JointShape& shape : kind.shapes())
    if (shape.front != 0) message.fronts.push_back(shape.front);
  if (!turns) return message;
  const Eigen::Vector3d to_hinge = mean.frame.col(1);
  const bool is_beside = std::abs(to_hinge.x()) > std::abs(to_hinge.y());
  message.hinge = is_beside ? (to_hinge.x() < 0 ? "left" : "right") : (to_hinge.y() < 0 ? "bottom" : "top");
  message.radius = mean.radius;
  const double across = is_beside ? message.width : message.height;
  message.radius_to_width = across > 0 ? mean.radius / across : 0;
  return message;
}

}  // namespace

std::vector<Kind> toMessages(const std::vector<core::JointKind>& kinds) {
  std::vector<Kind> messages;
  double joints = 0;
  for (const core::JointKind& kind : kinds) {
    messages.push_back(toMessage(kind));
    joints += messages.back().joints;
  }
  for (Kind& message : messages) message.share = message.joints / joints;
  std::stable_sort(messages.begin(), messages.end(), [](const Kind& a, const Kind& b) { return a.joints > b.joints; });
  return messages;
}

}  // namespace cabinet_articulation
