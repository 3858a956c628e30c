// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/bag_topics.h"

#include <rosbag/view.h>

#include "ros/images/compressed_images.h"
#include "tools/input/message_stream.h"

namespace cabinet_articulation {
namespace {

constexpr char kImage[] = "sensor_msgs/Image";
constexpr char kCompressedImage[] = "sensor_msgs/CompressedImage";
// The first that is there serves: without loss before with loss.
constexpr const char* kTransports[] = {"", "/compressedDepth", "/compressed"};

bool endsWith(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

}  // namespace

std::string uncompressed(const std::string& topic) {
  for (const std::string transport : {kTransports[1], kTransports[2]})
    if (endsWith(topic, transport)) return topic.substr(0, topic.size() - transport.size());
  return topic;
}

std::string namespaceOf(const std::string& topic) { return topic.substr(0, topic.rfind('/') + 1); }

BagTopics::BagTopics(const rosbag::Bag& bag) : bag_(bag) {
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    types_[connection->topic] = connection->datatype;
  for (const auto& [topic, type] : types_) {
    if (type != kImage && type != kCompressedImage) continue;
    const std::string image = type == kImage ? topic : uncompressed(topic);
    for (const char* transport : kTransports)
      if (const auto found = types_.find(image + transport);
          found != types_.end() && (found->second == kImage || found->second == kCompressedImage)) {
        recorded_[image] = found->first;
        break;
      }
  }
}

bool BagTopics::has(const std::string& topic, const std::string& type) const {
  if (type == kImage) return recorded_.count(topic) > 0;
  const auto found = types_.find(topic);
  return found != types_.end() && found->second == type;
}

bool BagTopics::hasExactly(const std::string& topic) const { return types_.count(topic) > 0; }

std::vector<std::string> BagTopics::all(const std::string& type, const std::string& below) const {
  std::vector<std::string> result;
  for (const auto& entry : type == kImage ? recorded_ : types_)
    if (has(entry.first, type) && (below.empty() || entry.first.rfind(below + "/", 0) == 0)) result.push_back(entry.first);
  return result;
}

std::string BagTopics::recorded(const std::string& image) const {
  const auto found = recorded_.find(image);
  return found == recorded_.end() ? image : found->second;
}

bool BagTopics::holdsDepth(const std::string& image) const try {
  rosbag::View view(bag_, rosbag::TopicQuery(recorded(image)));
  if (view.size() == 0) return false;
  if (const auto compressed = readMessage<sensor_msgs::CompressedImage>(*view.begin()))
    return cabinet_articulation::holdsDepth(*compressed);
  const auto raw = readMessage<sensor_msgs::Image>(*view.begin());
  return raw && (raw->encoding == "32FC1" || raw->encoding == "16UC1" || raw->encoding == "mono16");
} catch (const std::exception&) {
  return false;  // a damaged message, of a topic that nobody may want
}

std::string BagTopics::text() const {
  std::string text;
  for (const auto& [topic, type] : types_) text += "\n  " + topic + " (" + type + ")";
  return text.empty() ? "\n  none" : text;
}

}  // namespace cabinet_articulation
