// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <boost/make_shared.hpp>
#include <stdexcept>
#include <string>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "fuzz_target.h"
#include "tools/input/message_stream.h"

namespace cabinet_articulation::fuzz {

/// Serialized messages, one after the other.
class MessageReader {
 public:
  MessageReader(const std::uint8_t* data, std::size_t size)
      : bytes_(reinterpret_cast<const char*>(data), size), stream_(reinterpret_cast<std::uint8_t*>(&bytes_[0]), bytes_.size()) {}

  /// Throws StreamOverrunException, and std::invalid_argument for a stamp that no callback is called with.
  template <class Message>
  boost::shared_ptr<Message> next() {
    const auto message = boost::make_shared<Message>();
    stream_.next(*message);
    if constexpr (ros::message_traits::HasHeader<Message>::value) requireStamp("header.stamp", message->header.stamp);
    return message;
  }

  bool atEnd() { return stream_.getLength() == 0; }

 private:
  std::string bytes_;
  MessageStream stream_;
};

template <class... Messages>
std::string serialized(const Messages&... messages) {
  std::string bytes((ros::serialization::serializationLength(messages) + ... + 0), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(&bytes[0]), static_cast<std::uint32_t>(bytes.size()));
  (stream.next(messages), ...);
  return bytes;
}

/// examine() for messages, which the boundary refuses by these exceptions and the `Others`.
template <class... Others, class Work>
int examineMessages(const std::uint8_t* data, std::size_t size, const Work& work) {
  return examine<ros::serialization::StreamOverrunException, std::invalid_argument, Others...>([&] {
    MessageReader reader(data, size);
    work(reader);
  });
}

}  // namespace cabinet_articulation::fuzz
