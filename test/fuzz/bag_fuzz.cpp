// SPDX-License-Identifier: BSD-3-Clause
#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>

#include "cabinet_articulation/planes/plane_segmenter.h"
#include "messages.h"
#include "scratch_file.h"
#include "small_frame.h"
#include "tools/input/bag_transforms.h"
#include "tools/input/frame_bag.h"

namespace cabinet_articulation::fuzz {

/// A message's bytes, whether they are one or not.
template <class Message>
struct RawMessage {
  std::string bytes;
};

}  // namespace cabinet_articulation::fuzz

namespace ros {
namespace message_traits {

using cabinet_articulation::fuzz::RawMessage;

template <class Message>
struct MD5Sum<RawMessage<Message>> {
  static const char* value() { return MD5Sum<Message>::value(); }
  static const char* value(const RawMessage<Message>&) { return value(); }
};

template <class Message>
struct DataType<RawMessage<Message>> {
  static const char* value() { return DataType<Message>::value(); }
  static const char* value(const RawMessage<Message>&) { return value(); }
};

template <class Message>
struct Definition<RawMessage<Message>> {
  static const char* value() { return Definition<Message>::value(); }
  static const char* value(const RawMessage<Message>&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <class Message>
struct Serializer<cabinet_articulation::fuzz::RawMessage<Message>> {
  template <class Stream>
  static void write(Stream& stream, const cabinet_articulation::fuzz::RawMessage<Message>& message) {
    std::copy(message.bytes.begin(), message.bytes.end(), stream.advance(serializedLength(message)));
  }
  static std::uint32_t serializedLength(const cabinet_articulation::fuzz::RawMessage<Message>& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros

namespace cabinet_articulation::fuzz {
namespace {

constexpr char kStereo = 's', kDisparity = 'd', kDepth = 'z';

/// A whole message with its length.
template <class Message>
std::string framed(const Message& message) {
  const std::string bytes = serialized(message);
  return serialized(static_cast<std::uint32_t>(bytes.size())) + bytes;
}

/// Cuts what a bag is to hold into messages.
class BagWriter {
 public:
  BagWriter(const std::string& path, const std::uint8_t* data, std::size_t size)
      : stream_(const_cast<std::uint8_t*>(data), size), bag_(path, rosbag::bagmode::Write) {}

  template <class Message>
  void write(const std::string& topic) {
    std::uint32_t size = 0;
    stream_.next(size);
    size = std::min(size, stream_.getLength());
    const char* const bytes = reinterpret_cast<const char*>(stream_.advance(size));
    bag_.write(topic, time_ += ros::Duration(0.01), RawMessage<Message>{{bytes, size}});
  }

  bool atEnd() { return stream_.getLength() == 0; }

 private:
  MessageStream stream_;
  ros::Time time_{10};
  rosbag::Bag bag_;
};

void writeFrame(char kind, BagWriter* bag) {
  bag->write<tf2_msgs::TFMessage>("/tf");
  if (kind == kDepth) {
    bag->write<sensor_msgs::CameraInfo>("/stereo/depth/camera_info");
    return bag->write<sensor_msgs::Image>("/stereo/depth/image");
  }
  const std::string image = kind == kStereo ? "image_raw" : "image_rect";
  for (const char* const camera : {"/stereo/left/", "/stereo/right/"}) {
    bag->write<sensor_msgs::CameraInfo>(std::string(camera) + "camera_info");
    bag->write<sensor_msgs::Image>(camera + image);
  }
  if (kind == kDisparity) bag->write<stereo_msgs::DisparityImage>("/stereo/disparity");
}

/// The way of process_bag from a file to the frames.
void readFrames(const std::string& path, const std::string& kind) {
  static core::PlaneSegmenter segmenter{core::PlanesConfig()};
  FrameBagOptions options;
  options.input.kind = kind;
  FrameBag bag(path, options);
  const BagTransforms transforms(bag.bag());
  SkippedFrames skipped;
  const auto use = [&](const std_msgs::Header& header, const FrameViews& views) {
    try {
      transforms.lookup("map", header.frame_id, header.stamp);
    } catch (const tf2::TransformException& error) {
      skipped.add("no transform", error.what());
    }
    if (!views.frame.disparity.empty()) segmenter.process(views.frame);
  };
  bag.forEachFrame(use, &skipped);
}

}  // namespace

Seeds seeds() {
  const SmallFrame frame;
  tf2_msgs::TFMessage transforms;
  transforms.transforms = {exampleTransform()};
  const std::string tf = framed(transforms), left = framed(frame.info(false)) + framed(frame.image(false)),
                    right = framed(frame.info(true)) + framed(frame.image(true));
  sensor_msgs::CameraInfo distorted = frame.info(false);
  distorted.D = {-0.25, 0.125, 0.001, -0.002, 0.01};
  return {{kStereo + tf + left + right, kStereo + tf + framed(distorted) + framed(frame.image(false)) + right,
           kDisparity + tf + left + right + framed(frame.disparity()),
           kDepth + tf + framed(frame.info(false)) + framed(frame.depth())}};
}

}  // namespace cabinet_articulation::fuzz

/// A whole bag with arbitrary messages; the first byte says which kind of input. What else a file may be is rosbag's matter.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cabinet_articulation::fuzz;
  static const ScratchFile file("input.bag");
  const char kind = size > 0 ? static_cast<char>(data[0]) : kDepth;
  return examine<std::runtime_error, std::invalid_argument>([&] {
    {
      BagWriter bag(file.path(), data + 1, size > 0 ? size - 1 : 0);
      while (!bag.atEnd()) writeFrame(kind, &bag);
    }
    readFrames(file.path(), kind == kStereo ? "stereo" : kind == kDisparity ? "disparity" : "depth");
  });
}
