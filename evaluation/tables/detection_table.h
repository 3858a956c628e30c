// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "scores/detection_score.h"

namespace cabinet_articulation::core::evaluation {

/// One front in one frame in which it can be detected.
struct Judged {
  std::string source, variant, front;
  int frame = 0;
  double distance = 0;  ///< [m] from the camera to the front's centre
  int planes = 0;       ///< that the frame offers
  double searched = 0;  ///< planes searched until the front was found, NaN if it was not
  int others = 0;       ///< rectangles of the frame that are no judged front
  DetectionScore score;
};

/// What `seen` says about every front of the frame that can be detected; source, variant and frame are left to the caller.
std::vector<Judged> judge(const Frame& frame, const PipelineResult& seen);

/// Every row in `prefix`_frames.csv, means against distance in `prefix`.csv, and of every front in `prefix`_fronts.csv.
void writeDetectionTables(const std::vector<Judged>& judged, const std::string& prefix);

}  // namespace cabinet_articulation::core::evaluation
