// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {

DepthView toMessage(const core::DepthView& view) {
  DepthView message;
  message.columns = static_cast<std::uint32_t>(view.columns);
  message.rows = static_cast<std::uint32_t>(view.rows);
  message.fx = view.fx;
  message.fy = view.fy;
  message.cx = view.cx;
  message.cy = view.cy;
  message.camera = toMessage(view.T_fixed_camera);
  message.depth = view.depth;
  return message;
}

core::DepthView fromMessage(const DepthView& message) {
  if (message.columns == 0 && message.depth.empty()) return {};
  core::requireWithin("columns of the view", message.columns, {1, core::limits::kMostEntries, "cells"});
  core::requireWithin("rows of the view", message.rows, {1, core::limits::kMostEntries, "cells"});
  core::requireAtMost("cells in the view's depth", message.depth.size(), core::limits::kMostEntries);
  const std::uint64_t cells = std::uint64_t{message.columns} * message.rows;
  if (message.depth.size() != cells)
    throw std::invalid_argument("the view's depth has " + std::to_string(message.depth.size()) + " cells, expected " +
                                std::to_string(cells) + " for " + std::to_string(message.columns) + " columns");
  core::requireWithin("fx of the view", message.fx, core::limits::kCellFocalLength);
  core::requireWithin("fy of the view", message.fy, core::limits::kCellFocalLength);
  core::requireWithin("cx of the view", message.cx, core::limits::kPrincipalPoint);
  core::requireWithin("cy of the view", message.cy, core::limits::kPrincipalPoint);
  for (const float depth : message.depth) core::requireWithin("depth of the view", depth, core::limits::kViewDepth);
  core::DepthView view;
  view.columns = static_cast<int>(message.columns);
  view.rows = static_cast<int>(message.rows);
  view.fx = message.fx;
  view.fy = message.fy;
  view.cx = message.cx;
  view.cy = message.cy;
  view.T_fixed_camera = fromMessage(message.camera);
  view.depth = message.depth;
  return view;
}

}  // namespace cabinet_articulation
