// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>

#include <map>
#include <string>
#include <vector>

namespace cabinet_articulation {

/// The topics of a bag and their types. Images are known by the name that they have uncompressed: compressed ones have
/// /compressed or /compressedDepth behind it (image_transport).
class BagTopics {
 public:
  explicit BagTopics(const rosbag::Bag& bag);

  /// True if the topic is there and has this type; sensor_msgs/Image also for a compressed image.
  bool has(const std::string& topic, const std::string& type) const;

  bool hasExactly(const std::string& topic) const;

  /// All topics of a type below a namespace (without its last '/'; empty: everywhere). Sorted.
  std::vector<std::string> all(const std::string& type, const std::string& below) const;

  /// How the bag calls an image; the name itself if it is no compressed one.
  std::string recorded(const std::string& image) const;

  /// True if the first message on an image topic holds depth.
  bool holdsDepth(const std::string& image) const;

  /// One line for each topic.
  std::string text() const;

 private:
  const rosbag::Bag& bag_;
  std::map<std::string, std::string> types_;     ///< of all topics in the bag
  std::map<std::string, std::string> recorded_;  ///< of all images
};

/// The name of an image topic without what image_transport puts behind it.
std::string uncompressed(const std::string& topic);

/// The namespace of a topic, with its last '/'.
std::string namespaceOf(const std::string& topic);

}  // namespace cabinet_articulation
