// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "messages.h"
#include "small_frame.h"

using namespace cabinet_articulation;

namespace {

core::StereoConfig smallRange() {
  core::StereoConfig config;
  config.disparity_range = 16;
  return config;
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  const SmallFrame frame;
  sensor_msgs::CameraInfo far_sighted = frame.info(false);
  far_sighted.P[0] = 1e38;
  sensor_msgs::Image late = frame.image(false), wide = frame.image(false);
  late.header.stamp.sec = 4294967290U;
  // Its 48 rows of 2^28 + 64 bytes are 3072 bytes where 32 bits hold the product.
  wide.step += 1U << 28U;
  return {{serialized(frame.info(false), frame.info(true), frame.image(false), frame.image(true))},
          {serialized(far_sighted, frame.info(true), frame.image(false), frame.image(true)),
           serialized(frame.info(false), frame.info(true), late, frame.image(true)),
           serialized(frame.info(false), frame.info(true), wide, frame.image(true))}};
}

/// A pair of images and their CameraInfos, as the stereo stage gets them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static core::BlockMatcher matcher(smallRange());
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    const auto left_info = reader.next<sensor_msgs::CameraInfo>(), right_info = reader.next<sensor_msgs::CameraInfo>();
    const auto left_message = reader.next<sensor_msgs::Image>(), right_message = reader.next<sensor_msgs::Image>();
    const core::StereoCamera camera = toStereoCamera(*left_info, *right_info, "left", "right");
    const cv_bridge::CvImageConstPtr left = toMono(left_message, "left"), right = toMono(right_message, "right");
    requireSize(left->image, camera, "left");
    requireSize(right->image, camera, "right");
    toMessage(matcher.process(left->image, right->image, camera), left_message->header, 0, 16);
  });
}
