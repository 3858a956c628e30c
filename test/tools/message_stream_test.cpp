// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/message_stream.h"

#include <gtest/gtest.h>
#include <sensor_msgs/Image.h>
#include <tf2_msgs/TFMessage.h>

#include <cstring>

namespace cabinet_articulation {
namespace {

template <class Message>
std::vector<std::uint8_t> serialized(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream out(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(out, message);
  return bytes;
}

template <class Message>
Message read(std::vector<std::uint8_t> bytes) {
  MessageStream in(bytes.data(), bytes.size());
  Message message;
  in.next(message);
  return message;
}

TEST(MessageStream, ReadsWhatRosWrites) {
  sensor_msgs::Image image;
  image.header.frame_id = "camera";
  image.encoding = "mono8";
  image.data = {1, 2, 3};
  EXPECT_EQ(read<sensor_msgs::Image>(serialized(image)).data, image.data);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.resize(2);
  transforms.transforms[1].child_frame_id = "odom";
  EXPECT_EQ(read<tf2_msgs::TFMessage>(serialized(transforms)).transforms.at(1).child_frame_id, "odom");
}

TEST(MessageStream, MakesNoRoomForAListThatIsLongerThanItsMessage) {
  const std::uint32_t length = 0xf0000000U;  // elements; of transforms that would be a terabyte
  std::vector<std::uint8_t> bytes = serialized(tf2_msgs::TFMessage());
  std::memcpy(bytes.data(), &length, sizeof length);
  EXPECT_THROW(read<tf2_msgs::TFMessage>(bytes), ros::serialization::StreamOverrunException);
  bytes = serialized(sensor_msgs::Image());
  std::memcpy(&bytes[bytes.size() - sizeof length], &length, sizeof length);
  EXPECT_THROW(read<sensor_msgs::Image>(bytes), ros::serialization::StreamOverrunException);
}

}  // namespace
}  // namespace cabinet_articulation
