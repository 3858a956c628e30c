// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

#include "cabinet_articulation/pipeline/pipeline.h"

namespace cabinet_articulation {

/// Writes what the pipeline found to /cabinet/{rectangles,tracks,models} of a bag, with the stamps of the input. It is read in
/// the order in which it was written, also where stamps jump back: record times grow. The same results give the same bytes.
/// Throws std::runtime_error in words where the file cannot be written.
class ResultBag {
 public:
  explicit ResultBag(const std::string& path);

  /// One frame; the rectangles may be in a frame of their own. Tracks hold what is new, as the nodelet publishes them.
  void write(const std_msgs::Header& header, const RectangleArray& rectangles, const TrackArray& tracks,
             const std::vector<core::LearnedModel>& models);

  /// The whole histories, in a last message on /cabinet/tracks.
  void close(const std_msgs::Header& header, const std::vector<core::Track>& tracks);

 private:
  template <class Message>
  void add(const std::string& topic, const std_msgs::Header& header, const Message& message);

  rosbag::Bag bag_;
  std::string path_;
  ros::Time recorded_;  ///< of the last message
  DepthView view_;      ///< of the last frame
};

}  // namespace cabinet_articulation
