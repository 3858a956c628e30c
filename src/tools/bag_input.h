// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <string>

#include "ros/frame_assembler.h"

namespace cabinet_articulation {

/// Where in a bag the pipeline's input is.
struct BagInput {
  std::string kind;        ///< stereo, disparity or depth
  FrameTopics topics;      ///< stereo: `frame` is empty
  bool rectified = false;  ///< stereo: the images are rectified already
};

/// The topics of `kind` below the namespace `camera`, /stereo if that is empty. Where these are not complete, the only other ones
/// below `camera`, or in the whole bag if that is empty, of which types and names fit.
/// Throws std::invalid_argument for an unknown kind, and std::runtime_error that says which topics are missing and which there
/// are.
BagInput chooseInput(const rosbag::Bag& bag, const std::string& kind, const std::string& camera);

}  // namespace cabinet_articulation
