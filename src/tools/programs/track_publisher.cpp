// SPDX-License-Identifier: BSD-3-Clause
// Plays logs of poses, such as the original release's, onto `tracks`, pose by pose, as if a tracker saw them: the
// articulation nodelet learns from them.
#include <cabinet_articulation/TrackArray.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "cabinet_articulation/ros/conversions.h"
#include "ros/settings/parameters.h"
#include "tools/input/pose_log.h"
#include "tools/terminal/run_program.h"

namespace cabinet_articulation {
namespace {

constexpr char kUsage[] = "usage: track_publisher FILE... [_rate:=HZ] [_loop:=true] [_frame_id:=FRAME] [tracks:=TOPIC]\n";

struct Settings {
  double rate = 5;
  bool loop = false;
  std::string frame_id = "stereo_left_optical_frame";

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("rate", self.rate, core::Range{0.1, 1000}, "Hz", "poses a second (original release: 5)");
    visit("loop", self.loop, "start again at the end");
    visit("frame_id", self.frame_id, core::Choices{}, "frame of the poses");
  }
};

/// The logs up to pose `count`, seen at a pose every `period`, the newest at `now`.
std::vector<core::Track> firstPoses(const std::vector<core::Track>& logs, size_t count, const ros::Time& now, double period) {
  std::vector<core::Track> tracks = logs;
  for (core::Track& track : tracks) {
    track.observations.resize(std::min(count, track.observations.size()));
    for (size_t i = 0; i < track.observations.size(); ++i)
      track.observations[i].stamp = now.toSec() - period * static_cast<double>(count - 1 - i);
  }
  return tracks;
}

void play(std::vector<core::Track> logs, const Settings& settings) {
  ros::NodeHandle nh;
  const ros::Publisher publisher = nh.advertise<TrackArray>("tracks", 4);
  while (ros::ok() && publisher.getNumSubscribers() == 0) ros::WallDuration(0.1).sleep();
  size_t longest = 0;
  for (const core::Track& track : logs) longest = std::max(longest, track.observations.size());
  ros::Rate rate(settings.rate);
  const auto fronts = static_cast<std::uint32_t>(logs.size());
  do {
    for (size_t count = 1; count <= longest && ros::ok(); ++count) {
      std_msgs::Header header;
      header.stamp = ros::Time::now();
      header.frame_id = settings.frame_id;
      publisher.publish(toMessage(firstPoses(logs, count, header.stamp, 1 / settings.rate), header));
      rate.sleep();
    }
    // An id never means two tracks.
    for (core::Track& track : logs) track.id += fronts;
  } while (settings.loop && ros::ok());
}

std::vector<core::Track> readLogs(int count, char** files) {
  std::vector<core::Track> logs;
  for (int i = 0; i < count; ++i) {
    const core::PoseLog log = core::readPoseLog(files[i]);
    if (!log.warning.empty()) ROS_WARN("%s: %s", files[i], log.warning.c_str());
    logs.push_back(log.track);
    logs.back().id = static_cast<std::uint32_t>(i + 1);  // 0 is nobody
  }
  return logs;
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  using namespace cabinet_articulation;
  ros::init(argc, argv, "track_publisher");
  return runProgram("track_publisher", kUsage, [&] {
    if (argc < 2) throw std::invalid_argument("at least one file is expected");
    Settings settings;
    for (const std::string& warning : loadParameters(ros::NodeHandle("~"), settings)) ROS_WARN("%s", warning.c_str());
    play(readLogs(argc - 1, argv + 1), settings);
    return 0;
  });
}
