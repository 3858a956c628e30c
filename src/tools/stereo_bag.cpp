// SPDX-License-Identifier: BSD-3-Clause
#include "stereo_bag.h"

#include <rosbag/view.h>

#include <filesystem>
#include <set>
#include <stdexcept>

namespace cabinet_articulation {
namespace {

constexpr size_t kLongestWait = 30;  ///< images kept of one side while the other side's are missing
const char* const kSides[] = {"left", "right"};

std::string stampText(const ros::Time& stamp) {
  char text[32];
  std::snprintf(text, sizeof text, "%u.%09u", stamp.sec, stamp.nsec);
  return text;
}

void openBag(const std::string& path, rosbag::Bag* bag) {
  if (!std::filesystem::exists(path)) throw std::runtime_error(path + ": no such file");
  if (!std::filesystem::is_regular_file(path)) throw std::runtime_error(path + ": not a file");
  try {
    bag->open(path, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    throw std::runtime_error(path + ": the bag was not closed or is cut off and has no index; 'rosbag reindex " + path +
                             "' saves what is readable");
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": not a complete bag file (" + error.what() + "); 'rosbag reindex " + path +
                             "' may save what is readable");
  }
}

/// Topics and their types.
std::map<std::string, std::string> topicsOf(const rosbag::Bag& bag) {
  std::map<std::string, std::string> topics;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections())
    topics[connection->topic] = connection->datatype;
  return topics;
}

/// Images of both sides that wait for their counterpart.
class PairMatcher {
 public:
  explicit PairMatcher(SkippedFrames* skipped) : skipped_(skipped) {}

  /// The counterpart of the image, or null if it has not come yet.
  sensor_msgs::ImageConstPtr match(int side, const sensor_msgs::ImageConstPtr& image) {
    const ros::Time stamp = image->header.stamp;
    const auto found = waiting_[1 - side].find(stamp);
    if (found == waiting_[1 - side].end()) {
      waiting_[side][stamp] = image;
      if (waiting_[side].size() > kLongestWait) giveUp(side, std::next(waiting_[side].begin())->first);
      return nullptr;
    }
    const sensor_msgs::ImageConstPtr counterpart = found->second;
    waiting_[1 - side].erase(found);
    for (int other : {0, 1}) giveUp(other, stamp);
    return counterpart;
  }

  void giveUpAll() {
    for (int side : {0, 1}) giveUp(side, ros::TIME_MAX);
  }

 private:
  /// Nothing older than `stamp` will find a counterpart any more.
  void giveUp(int side, const ros::Time& stamp) {
    while (!waiting_[side].empty() && waiting_[side].begin()->first < stamp) {
      skipped_->add(std::string(kSides[side]) + " image without a " + kSides[1 - side] + " image of the same stamp",
                    stampText(waiting_[side].begin()->first));
      waiting_[side].erase(waiting_[side].begin());
    }
  }

  SkippedFrames* skipped_;
  std::map<ros::Time, sensor_msgs::ImageConstPtr> waiting_[2];
};

}  // namespace

StereoBag::StereoBag(const std::string& path, const std::string& camera) : path_(path) {
  openBag(path, &bag_);
  chooseTopics(camera);
}

void StereoBag::chooseTopics(const std::string& camera) {
  const std::map<std::string, std::string> topics = topicsOf(bag_);
  const auto has = [&topics](const std::string& topic, const char* type) {
    const auto found = topics.find(topic);
    return found != topics.end() && found->second == type;
  };
  const auto hasBoth = [&](const std::string& image) {
    return has(camera + "/left/" + image, "sensor_msgs/Image") && has(camera + "/right/" + image, "sensor_msgs/Image");
  };
  rectified_ = hasBoth("image_rect") && !hasBoth("image_raw");
  std::string missing;
  for (int side : {0, 1}) {
    image_topics_[side] = camera + "/" + kSides[side] + (rectified_ ? "/image_rect" : "/image_raw");
    info_topics_[side] = camera + "/" + kSides[side] + "/camera_info";
    if (!has(image_topics_[side], "sensor_msgs/Image")) missing += "\n  " + image_topics_[side] + " (sensor_msgs/Image)";
    if (!has(info_topics_[side], "sensor_msgs/CameraInfo")) missing += "\n  " + info_topics_[side] + " (sensor_msgs/CameraInfo)";
  }
  if (missing.empty()) return;
  std::string there;
  for (const auto& [topic, type] : topics) there += "\n  " + topic + " (" + type + ")";
  throw std::runtime_error(path_ + ": missing topics:" + missing + "\nin the bag are:" + (there.empty() ? "\n  none" : there));
}

StereoBag::Infos StereoBag::readInfos(int side) const {
  Infos infos;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag_, rosbag::TopicQuery(info_topics_[side])))
    if (const auto info = instance.instantiate<sensor_msgs::CameraInfo>()) infos[info->header.stamp] = info;
  if (infos.empty()) throw std::runtime_error(path_ + ": no message on " + info_topics_[side]);
  return infos;
}

void StereoBag::forEachPair(const std::function<void(const StereoPair&)>& callback, SkippedFrames* skipped) const {
  const Infos infos[] = {readInfos(0), readInfos(1)};
  const auto infoAt = [&infos](int side, const ros::Time& stamp) {
    const auto next = infos[side].upper_bound(stamp);
    return next == infos[side].begin() ? next->second : std::prev(next)->second;
  };
  PairMatcher matcher(skipped);
  const std::vector<std::string> topics(image_topics_, image_topics_ + 2);
  for (const rosbag::MessageInstance& instance : rosbag::View(bag_, rosbag::TopicQuery(topics))) {
    const auto image = instance.instantiate<sensor_msgs::Image>();
    if (!image) throw std::runtime_error(path_ + ": unreadable message on " + instance.getTopic());
    const int side = instance.getTopic() == image_topics_[0] ? 0 : 1;
    const sensor_msgs::ImageConstPtr counterpart = matcher.match(side, image);
    if (!counterpart) continue;
    const ros::Time stamp = image->header.stamp;
    callback({side == 0 ? image : counterpart, side == 0 ? counterpart : image, infoAt(0, stamp), infoAt(1, stamp)});
  }
  matcher.giveUpAll();
}

}  // namespace cabinet_articulation
