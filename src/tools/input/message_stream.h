// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/serialization.h>
#include <rosbag/message_instance.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace cabinet_articulation {

/// As ros::serialization::IStream, but a list is no longer than the bytes that are left. ROS itself makes room for whatever a
/// length says, up to terabytes, before it looks whether so much is there.
class MessageStream : public ros::serialization::Stream {
 public:
  MessageStream(std::uint8_t* data, std::size_t size) : Stream(data, static_cast<std::uint32_t>(size)) {}

  template <class Value>
  void next(Value& value) {
    deserialize(*this, value);
  }
};

/// Found by its argument when ROS reads a list. Throws StreamOverrunException.
template <class Element, class Allocator>
void deserialize(MessageStream& stream, std::vector<Element, Allocator>& list) {
  MessageStream ahead(stream.getData(), stream.getLength());
  std::uint32_t length = 0;
  ahead.next(length);
  if (length > ahead.getLength()) throw ros::serialization::StreamOverrunException("a list is longer than its message");
  ros::serialization::VectorSerializer<Element, Allocator>::read(stream, list);
}

/// A message of a bag; null if it is of another type. Throws std::runtime_error for a damaged one.
template <class Message>
boost::shared_ptr<Message> readMessage(const rosbag::MessageInstance& instance) {
  if (!instance.isType<Message>()) return {};
  // Not without a byte, for ROS counts on from where they begin.
  std::vector<std::uint8_t> bytes(std::max<std::size_t>(instance.size(), 1));
  ros::serialization::OStream out(bytes.data(), instance.size());
  instance.write(out);
  MessageStream in(bytes.data(), instance.size());
  const auto message = boost::make_shared<Message>();
  try {
    in.next(*message);
  } catch (const ros::serialization::StreamOverrunException&) {
    throw std::runtime_error("damaged message on " + instance.getTopic() + ": it ends before all its fields");
  }
  return message;
}

}  // namespace cabinet_articulation
