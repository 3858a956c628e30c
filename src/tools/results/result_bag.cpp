// SPDX-License-Identifier: BSD-3-Clause
#include "tools/results/result_bag.h"

#include <algorithm>
#include <stdexcept>

#include "cabinet_articulation/ros/conversions.h"

namespace cabinet_articulation {

ResultBag::ResultBag(const std::string& path) : path_(path) {
  try {
    bag_.open(path, rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": cannot be written (" + error.what() + ")");
  }
}

template <class Message>
void ResultBag::add(const std::string& topic, const std_msgs::Header& header, const Message& message) {
  // The stamp itself unless it would not be the latest: what reads a bag sorts by the record time.
  recorded_ = std::max(header.stamp, recorded_ + ros::Duration(0, 1));
  try {
    bag_.write(topic, recorded_, message);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path_ + ": cannot be written (" + error.what() + ")");
  }
}

void ResultBag::write(const std_msgs::Header& header, const RectangleArray& rectangles, const TrackArray& tracks,
                      const std::vector<core::LearnedModel>& models) {
  add("/cabinet/rectangles", header, rectangles);
  add("/cabinet/tracks", header, tracks);
  view_ = tracks.view;
  add("/cabinet/models", header, toMessage(models, header));
}

void ResultBag::close(const std_msgs::Header& header, const std::vector<core::Track>& tracks) {
  TrackArray whole = toMessage(tracks, header);
  whole.view = view_;
  add("/cabinet/tracks", header, whole);
  bag_.close();
}

}  // namespace cabinet_articulation
