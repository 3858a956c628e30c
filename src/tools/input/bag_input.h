// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <string>

#include "ros/input/frame_assembler.h"

namespace cabinet_articulation {

/// What the user says about the input; all may be empty.
struct InputOptions {
  std::string kind;        ///< stereo, disparity or depth
  std::string camera;      ///< namespace of the topics, with a leading '/'
  bool rectified = false;  ///< stereo: also where the topics' names do not say it
  std::string left_image, left_info, right_image, right_info, disparity, depth_image, depth_info;  ///< topics
};

/// Where in a bag the pipeline's input is.
struct BagInput {
  std::string kind;        ///< stereo, disparity or depth
  FrameTopics topics;      ///< as they are called in the bag, compressed ones too; stereo: `frame` is empty
  bool rectified = false;  ///< stereo: the images are rectified already
};

/// The input of a bag. Topics that are named are taken; the kind is the one they belong to. All others are looked for under the
/// default names below `camera`, or below /stereo if that is empty. The kind is stereo there unless it is given. Where these
/// are not complete, topics are found by type below `camera`, or in the whole bag. An image may be compressed; then it is known
/// by the name of the image or by its own. Throws std::invalid_argument for options that contradict each other, and
/// std::runtime_error that says which topics are missing or which inputs fit, and which topics there are.
BagInput chooseInput(const rosbag::Bag& bag, const InputOptions& options);

}  // namespace cabinet_articulation
