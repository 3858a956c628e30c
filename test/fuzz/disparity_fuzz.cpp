// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "cabinet_articulation/ros/frame_assembler.h"
#include "cabinet_articulation/ros/plane_messages.h"
#include "messages.h"
#include "small_frame.h"

using namespace cabinet_articulation;

std::vector<std::string> fuzz::seeds() {
  const SmallFrame frame;
  return {serialized(frame.info(false), frame.info(true), frame.disparity(), frame.image(false), frame.image(true))};
}

/// A disparity image, its images and its CameraInfos, as the planes stage gets them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static core::PlaneSegmenter segmenter{core::PlanesConfig()};
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    FrameMessages messages;
    messages.info = reader.next<sensor_msgs::CameraInfo>();
    messages.right_info = reader.next<sensor_msgs::CameraInfo>();
    messages.disparity = reader.next<stereo_msgs::DisparityImage>();
    messages.left = reader.next<sensor_msgs::Image>();
    messages.right = reader.next<sensor_msgs::Image>();
    const FrameAssembler assembler({}, {}, FrameTopics::below("", "disparity"), {});
    const FrameViews views = assembler.view(messages);
    PlaneMessages().make(segmenter.process(views.frame), messages.header());
  });
}
