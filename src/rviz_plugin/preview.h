// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/PoseWithCovariance.h>
#include <std_msgs/Header.h>

#include <memory>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "rviz_plugin/shown_drawing.h"

namespace rviz {
class DisplayContext;
}

namespace cabinet_articulation {

/// What the panel draws into RViz: where a front would be, and the way of a hand that holds it. Without RViz it draws nothing.
class Preview {
 public:
  explicit Preview(rviz::DisplayContext* context);

  /// These throw std::invalid_argument for poses that are none.
  void showFront(const std_msgs::Header& header, const core::LearnedModel& model, const geometry_msgs::PoseWithCovariance& pose);
  void showPath(const std_msgs::Header& header, const std::vector<geometry_msgs::PoseWithCovariance>& path);
  void hidePath();
  void clear();

  /// Places both where their frame is now.
  void follow();

 private:
  void redraw();

  rviz::DisplayContext* context_;
  std::unique_ptr<ShownDrawing> shown_;
  std_msgs::Header header_;
  Drawing front_, path_;
};

}  // namespace cabinet_articulation
