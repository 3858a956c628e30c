// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation {

/// Outlines, namespace `rectangles`, numbered in order.
void addMarkers(const std::vector<core::DetectedRectangle>& rectangles, const std_msgs::Header& header,
                visualization_msgs::MarkerArray* markers);

/// For each model, under its id: the front now (`fronts`), and for joints the axis (`axes`), the predicted fronts over
/// the range (`sweep`) and a text (`labels`).
void addMarkers(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header,
                visualization_msgs::MarkerArray* markers);

/// Remembers what is shown, so that what vanished is deleted.
class MarkerHistory {
 public:
  /// Appends a DELETE for every marker of the last call that is no longer there.
  void deleteVanished(visualization_msgs::MarkerArray* markers);

 private:
  using Key = std::pair<std::string, int>;
  std::set<Key> shown_;
};

}  // namespace cabinet_articulation
