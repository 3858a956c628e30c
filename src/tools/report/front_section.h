// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tools/report/frame_pictures.h"
#include "tools/report/run_record.h"

namespace cabinet_articulation {

/// What the page says of the run as a whole.
struct RunFacts {
  std::string bag, command;
  std::string input;        ///< stereo, disparity or depth
  std::string fixed_frame;  ///< of all poses
  Eigen::Vector3d upwards;  ///< in that frame
  std::string troubles;     ///< lines about what could not be used; empty: nothing
};

/// The front's line in the table of all, under the headings.
std::vector<std::string> frontColumns();
std::string frontRow(const FrontRecord& front);

/// All that is known of one front.
std::string frontSection(const FrontRecord& front, const RunFacts& facts, const RunRecord& record, const Picture* first);

}  // namespace cabinet_articulation
