// SPDX-License-Identifier: BSD-3-Clause
#include "tools/bag_input.h"

#include <rosbag/view.h>

#include <map>
#include <stdexcept>
#include <vector>

#include "tools/message_stream.h"

namespace cabinet_articulation {
namespace {

constexpr char kDefaultCamera[] = "/stereo";
constexpr char kImage[] = "sensor_msgs/Image";
constexpr char kInfo[] = "sensor_msgs/CameraInfo";
constexpr char kDisparity[] = "stereo_msgs/DisparityImage";

using Topics = std::map<std::string, std::string>;  ///< and their types

Topics topicsOf(const rosbag::Bag& bag) {
  Topics topics;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    topics[connection->topic] = connection->datatype;
  return topics;
}

/// All of them for no camera.
Topics below(const std::string& camera, const Topics& topics) {
  Topics result;
  for (const auto& entry : topics)
    if (camera.empty() || entry.first.rfind(camera + "/", 0) == 0) result.insert(entry);
  return result;
}

bool has(const Topics& topics, const std::string& topic, const char* type) {
  const auto found = topics.find(topic);
  return found != topics.end() && found->second == type;
}

/// Below a namespace that ends in '/'.
BagInput inputBelow(const std::string& camera, const std::string& kind, const Topics& topics) {
  BagInput input{kind, FrameTopics::below(camera, kind)};
  if (kind != "stereo") return input;
  const std::string raw[] = {camera + "left/image_raw", camera + "right/image_raw"};
  const bool has_raw = has(topics, raw[0], kImage) && has(topics, raw[1], kImage);
  input.rectified = has(topics, input.topics.left, kImage) && has(topics, input.topics.right, kImage) && !has_raw;
  input.topics.frame.clear();
  if (input.rectified) return input;
  input.topics.left = raw[0];
  input.topics.right = raw[1];
  return input;
}

/// One line for each topic; empty if all are there.
std::string missingTopics(const BagInput& input, const Topics& topics) {
  std::vector<std::pair<std::string, const char*>> needed{{input.topics.info, kInfo}};
  if (input.kind == "stereo")
    needed.insert(needed.end(), {{input.topics.left, kImage}, {input.topics.right, kImage}, {input.topics.right_info, kInfo}});
  else
    needed.emplace_back(input.topics.frame, input.kind == "depth" ? kImage : kDisparity);
  std::string missing;
  for (const auto& [topic, type] : needed)
    if (!has(topics, topic, type)) missing += "\n  " + topic + " (" + type + ")";
  return missing;
}

bool holdsDepth(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() == 0) return false;
  const auto image = readMessage<sensor_msgs::Image>(*view.begin());
  return image && (image->encoding == "32FC1" || image->encoding == "16UC1" || image->encoding == "mono16");
}

/// The namespace of a topic, with its last '/'.
std::string namespaceOf(const std::string& topic) { return topic.substr(0, topic.rfind('/') + 1); }

/// Complete ones, under whatever name.
std::vector<BagInput> inputsByType(const rosbag::Bag& bag, const std::string& kind, const Topics& topics) {
  std::vector<BagInput> inputs;
  for (const auto& [topic, type] : topics) {
    BagInput input;
    if (kind == "depth" && type == kImage && has(topics, namespaceOf(topic) + "camera_info", kInfo) && holdsDepth(bag, topic)) {
      input = {kind, {topic, namespaceOf(topic) + "camera_info", "", "", ""}};
    } else if (kind == "disparity" && type == kDisparity) {
      input = inputBelow(namespaceOf(topic), kind, topics);
      input.topics.frame = topic;
    } else if (const size_t left = topic.rfind("left/camera_info"); kind == "stereo" && left != std::string::npos) {
      input = inputBelow(topic.substr(0, left), kind, topics);
    } else {
      continue;
    }
    if (missingTopics(input, topics).empty()) inputs.push_back(input);
  }
  return inputs;
}

std::string listOf(const Topics& topics) {
  std::string text;
  for (const auto& [topic, type] : topics) text += "\n  " + topic + " (" + type + ")";
  return text.empty() ? "\n  none" : text;
}

}  // namespace

BagInput chooseInput(const rosbag::Bag& bag, const std::string& kind, const std::string& camera) {
  if (kind != "stereo" && kind != "disparity" && kind != "depth")
    throw std::invalid_argument("input is '" + kind + "', expected stereo, disparity or depth");
  const Topics topics = topicsOf(bag);
  const BagInput input = inputBelow((camera.empty() ? kDefaultCamera : camera) + "/", kind, topics);
  std::string missing = missingTopics(input, topics);
  if (missing.empty()) return input;
  const std::vector<BagInput> others = inputsByType(bag, kind, below(camera, topics));
  if (others.size() == 1) return others[0];
  if (others.size() > 1) missing += "\nand " + std::to_string(others.size()) + " others fit, choose one by its --camera";
  throw std::runtime_error(bag.getFileName() + ": missing topics:" + missing + "\nin the bag are:" + listOf(topics));
}

}  // namespace cabinet_articulation
