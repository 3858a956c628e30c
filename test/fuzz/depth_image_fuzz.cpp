// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "messages.h"
#include "ros/input/frame_assembler.h"
#include "ros/messages/plane_messages.h"
#include "small_frame.h"

using namespace cabinet_articulation;

fuzz::Seeds fuzz::seeds() {
  const SmallFrame frame;
  sensor_msgs::Image millimetres = test::greyImage(128, 48, frame.header, [](int u, int) { return u % 2 == 0 ? 0 : 4; });
  millimetres.encoding = sensor_msgs::image_encodings::TYPE_16UC1;
  millimetres.step = millimetres.width;
  millimetres.width /= 2;
  return {{serialized(frame.info(false), frame.depth()), serialized(frame.info(false), millimetres)}};
}

/// A depth image and its CameraInfo, as the planes stage gets them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static core::PlaneSegmenter segmenter{core::PlanesConfig()};
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    FrameMessages messages;
    messages.info = reader.next<sensor_msgs::CameraInfo>();
    messages.depth = reader.next<sensor_msgs::Image>();
    FrameInputConfig input;
    input.input = "depth";
    const FrameAssembler assembler(input, {}, FrameTopics::below("", "depth"), {});
    const FrameViews views = assembler.view(messages);
    PlaneMessages().make(segmenter.process(views.frame), messages.header());
  });
}
