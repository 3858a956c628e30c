// SPDX-License-Identifier: BSD-3-Clause
#include <boost/make_shared.hpp>

#include "bend/bend_correction.h"
#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/image_conversions.h"
#include "messages.h"
#include "ros/input/frame_assembler.h"
#include "ros/messages/plane_messages.h"
#include "small_frame.h"

using namespace cabinet_articulation;

namespace {

FrameMessages messagesOf(const fuzz::SmallFrame& frame) {
  FrameMessages messages;
  messages.info = boost::make_shared<sensor_msgs::CameraInfo>(frame.info(false));
  messages.right_info = boost::make_shared<sensor_msgs::CameraInfo>(frame.info(true));
  messages.disparity = boost::make_shared<stereo_msgs::DisparityImage>(frame.disparity());
  messages.left = boost::make_shared<sensor_msgs::Image>(frame.image(false));
  messages.right = boost::make_shared<sensor_msgs::Image>(frame.image(true));
  return messages;
}

FrameAssembler assembler() { return {{}, {}, FrameTopics::below("", "disparity"), {}}; }

ExpectedFrontArray expectedFronts(const fuzz::SmallFrame& frame) {
  core::ExpectedFront front;
  front.stamp = frame.header.stamp.toSec() - 0.07;
  front.rectangle = frame.scene.front;
  front.velocity = {0.1, 0.2, -0.3};
  front.angular_velocity = {0.02, 0.3, 0.01};
  return toMessage(core::ExpectedFronts{0.3, {front}}, frame.header);
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  const SmallFrame frame;
  const FrameMessages messages = messagesOf(frame);
  const FrameViews views = assembler().view(messages);
  const auto regions = core::PlaneSegmenter(core::PlanesConfig()).process(views.frame);
  if (regions.size() < 2) detail::report("the small frame has no front before a wall");
  const PlaneArray planes = *PlaneMessages().make(regions, frame.header);
  const auto with = [&](const sensor_msgs::CameraInfo& info, const PlaneArray& changed) {
    return serialized(info, *messages.right_info, exampleTransform(), expectedFronts(frame), changed);
  };
  sensor_msgs::CameraInfo far_sighted = *messages.info;
  far_sighted.P[0] = 1e38;
  PlaneArray late = planes, far = planes, bent = planes, short_of_a_term = planes;
  late.header.stamp.sec = 4294967290U;
  far.planes[0].hull[0].x = 3e38F;
  bent.bend.assign(core::kBendTerms, 0.25);
  short_of_a_term.bend.assign(core::kBendTerms - 1, 0.25);
  return {
      {with(*messages.info, planes), with(*messages.info, bent)},
      {with(far_sighted, planes), with(*messages.info, late), with(*messages.info, far), with(*messages.info, short_of_a_term)}};
}

/// Planes, CameraInfos and expected fronts, as the rectangles stage gets them. The pixels are always the same.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static core::RectangleDetector detector{core::RectanglesConfig(), core::PlanesConfig()};
  static core::BendCorrection correction;
  static const FrameMessages pixels = messagesOf(fuzz::SmallFrame());
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    FrameMessages messages = pixels;
    messages.info = reader.next<sensor_msgs::CameraInfo>();
    messages.right_info = reader.next<sensor_msgs::CameraInfo>();
    const auto transform = reader.next<geometry_msgs::TransformStamped>();
    const auto expected = reader.next<ExpectedFrontArray>();
    const auto planes = reader.next<PlaneArray>();
    std::vector<core::Rectangle> proposals;
    try {
      proposals = core::expectedInCamera(fromMessage(*expected), planes->header.stamp.toSec(), fuzz::throughTf(*transform));
    } catch (const std::invalid_argument&) {  // the stage goes on without
    }
    const FrameViews views = assembler().view(messages);
    const core::DepthFrame flat = correction.process(views.frame, bendOf(*planes));
    toMessage(detector.process(flat, fromMessage(*planes), proposals), planes->header);
    toMessage(core::thinnedOut(flat));
  });
}
