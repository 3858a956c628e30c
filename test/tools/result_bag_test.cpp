// SPDX-License-Identifier: BSD-3-Clause
#include "tools/results/result_bag.h"

#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace cabinet_articulation {
namespace {

using Entry = std::pair<std::string, ros::Time>;  ///< topic, and stamp in the header

class ResultBagTest : public testing::Test {
 protected:
  ResultBagTest() : path_(std::filesystem::temp_directory_path() / ("result_bag_test_" + std::to_string(::getpid()) + ".bag")) {}
  ~ResultBagTest() override { std::filesystem::remove(path_); }

  void write(const std::vector<ros::Time>& stamps) const {
    ResultBag bag(path_.string());
    std_msgs::Header header;
    for (const ros::Time& stamp : stamps) {
      header.stamp = stamp;
      RectangleArray rectangles;
      rectangles.header = header;
      TrackArray tracks;
      tracks.header = header;
      bag.write(header, rectangles, tracks, {});
    }
    bag.close(header, {});
  }

  /// What a reader comes to see, one after the other.
  std::vector<Entry> read() const {
    std::vector<Entry> entries;
    rosbag::Bag bag(path_.string());
    ros::Time last;
    for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
      EXPECT_GT(instance.getTime(), last) << instance.getTopic();
      last = instance.getTime();
      if (const auto message = instance.instantiate<RectangleArray>()) entries.emplace_back("rectangles", message->header.stamp);
      if (const auto message = instance.instantiate<TrackArray>()) entries.emplace_back("tracks", message->header.stamp);
      if (const auto message = instance.instantiate<ArticulationModelArray>())
        entries.emplace_back("models", message->header.stamp);
    }
    return entries;
  }

  std::string bytes() const {
    std::ifstream file(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::filesystem::path path_;
};

std::vector<Entry> inThisOrder(const std::vector<ros::Time>& stamps) {
  std::vector<Entry> entries;
  for (const ros::Time& stamp : stamps)
    for (const char* topic : {"rectangles", "tracks", "models"}) entries.emplace_back(topic, stamp);
  entries.emplace_back("tracks", stamps.back());
  return entries;
}

TEST_F(ResultBagTest, IsReadAsItWasWrittenAlsoWhereStampsJumpBack) {
  for (const std::vector<ros::Time>& stamps : std::vector<std::vector<ros::Time>>{
           {ros::Time(100), ros::Time(101), ros::Time(102), ros::Time(100), ros::Time(101), ros::Time(102)},
           {ros::Time(100), ros::Time(5), ros::Time(6), ros::Time(200)},
           {ros::Time(0), ros::Time(0)}}) {
    write(stamps);
    EXPECT_EQ(read(), inThisOrder(stamps));
  }
}

TEST_F(ResultBagTest, RecordsEachFrameAtItsStampIfThatIsTheLatest) {
  write({ros::Time(100), ros::Time(5), ros::Time(200)});
  rosbag::Bag bag(path_.string());
  std::vector<ros::Time> times;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery("/cabinet/rectangles")))
    times.push_back(instance.getTime());
  EXPECT_EQ(times, (std::vector<ros::Time>{ros::Time(100), ros::Time(100, 3), ros::Time(200)}));
}

TEST_F(ResultBagTest, TheSameResultsGiveTheSameBytes) {
  const std::vector<ros::Time> stamps = {ros::Time(100), ros::Time(102), ros::Time(100), ros::Time(102)};
  write(stamps);
  const std::string first = bytes();
  write(stamps);
  EXPECT_FALSE(first.empty());
  EXPECT_TRUE(bytes() == first);
}

}  // namespace
}  // namespace cabinet_articulation
