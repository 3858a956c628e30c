// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "messages.h"
#include "ros/input/frame_assembler.h"
#include "ros/messages/plane_messages.h"
#include "small_frame.h"

using namespace cabinet_articulation;

fuzz::Seeds fuzz::seeds() {
  const SmallFrame frame;
  sensor_msgs::CameraInfo far_sighted = frame.info(false);
  far_sighted.P[0] = 1e38;
  stereo_msgs::DisparityImage late = frame.disparity(), flat = frame.disparity();
  late.header.stamp.sec = 4294967290U;
  flat.T = 1e-38F;
  const std::string images = serialized(frame.image(false), frame.image(true));
  return {{serialized(frame.info(false), frame.info(true), frame.disparity()) + images},
          {serialized(far_sighted, frame.info(true), frame.disparity()) + images,
           serialized(frame.info(false), frame.info(true), late) + images,
           serialized(frame.info(false), frame.info(true), flat) + images}};
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
