// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/TrackArray.h>
#include <rosbag/view.h>
#include <sys/stat.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <set>

#include "geometry/degrees.h"
#include "tools/input/scene_bag.h"
#include "tools/stereo_bag_fixture.h"

namespace cabinet_articulation {
namespace {

class ProcessBag : public StereoBagFixture {
 protected:
  /// A few small grey frames; `spoil` changes each before it is written.
  void writeGrey(
      const std::string& name, const std::function<void(int, Frame&)>& spoil = [](int, Frame&) {}) const {
    core::StereoCamera camera;
    camera.width = 320;
    camera.height = 240;
    camera.fx = camera.fy = 300;
    camera.cx = 160;
    camera.cy = 120;
    camera.baseline = 0.1;
    rosbag::Bag bag(path(name), rosbag::bagmode::Write);
    for (int i = 0; i < 3; ++i) {
      const ros::Time stamp(100 + i);
      const cv::Mat1b grey(camera.height, camera.width, 100);
      Frame frame{imageOf(grey, stamp), imageOf(grey, stamp), infoOf(camera, false, stamp), infoOf(camera, true, stamp)};
      spoil(i, frame);
      write(bag, frame, stamp);
    }
  }

  /// The simulated door from a wandering camera, with tf. `frames` of it, the whole run if 0. Returns their number.
  int writeDoor(const std::string& name, int frames = 0) const {
    SceneBagConfig config;
    config.simulation.scene = "door";
    config.simulation.rate = 3;
    config.simulation.camera_motion = 0.05;
    config.frames = frames;
    config.start = ros::Time(100);
    return writeSceneBag(path(name), config);
  }
};

TEST_F(ProcessBag, LearnsADoorInTheFixedFrame) {
  const int frames = writeDoor("door.bag");
  const Outcome outcome = run("door.bag out.bag --fixed-frame world");
  ASSERT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("rotational"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("articulation"), std::string::npos) << "milliseconds of each stage";

  rosbag::Bag bag(path("out.bag"));
  std::set<ros::Time> stamps;
  ArticulationModelArray::ConstPtr models;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    if (const auto rectangles = instance.instantiate<RectangleArray>()) {
      EXPECT_EQ(rectangles->header.frame_id, "world");
      stamps.insert(rectangles->header.stamp);
    }
    if (const auto message = instance.instantiate<ArticulationModelArray>()) models = message;
  }
  EXPECT_EQ(stamps.size(), static_cast<size_t>(frames)) << "every frame, with its own stamp";
  EXPECT_EQ(*stamps.begin(), ros::Time(100));
  ASSERT_TRUE(models);
  int movers = 0;
  for (const ArticulationModel& model : models->models) {
    if (!model.moved) continue;
    ++movers;
    EXPECT_GT(std::abs(model.axis.z), std::cos(3 * core::kDegree)) << "the hinge is upright in the world";
  }
  EXPECT_EQ(movers, 1);
}

TEST_F(ProcessBag, LeavesRectanglesInTheCamerasFrameIfAsked) {
  writeDoor("door.bag", 6);
  ASSERT_EQ(run("door.bag camera.bag").status, 0);
  ASSERT_EQ(run("door.bag both.bag --fixed-frame world --camera-rectangles").status, 0);
  const auto first = [this](const std::string& name) {
    rosbag::Bag bag(path(name));
    for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery("/cabinet/rectangles")))
      if (const auto message = instance.instantiate<RectangleArray>(); !message->rectangles.empty()) return *message;
    return RectangleArray();
  };
  const RectangleArray expected = first("camera.bag");
  const RectangleArray rectangles = first("both.bag");
  ASSERT_FALSE(expected.rectangles.empty());
  EXPECT_EQ(rectangles.header, expected.header);
  EXPECT_EQ(rectangles.rectangles, expected.rectangles);
  rosbag::Bag bag(path("both.bag"));
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery("/cabinet/tracks")))
    EXPECT_EQ(instance.instantiate<TrackArray>()->header.frame_id, "world");
}

TEST_F(ProcessBag, TheSameInputGivesTheSameBytes) {
  writeDoor("door.bag", 10);
  ASSERT_EQ(run("door.bag first.bag").status, 0);
  ASSERT_EQ(run("door.bag second.bag").status, 0);
  EXPECT_GT(bytes(path("first.bag")).size(), 10000u);
  EXPECT_TRUE(bytes(path("first.bag")) == bytes(path("second.bag")));
}

TEST_F(ProcessBag, WritesAllTopicsAlsoWhenNothingIsSeen) {
  writeGrey("grey.bag");
  const Outcome outcome = run("grey.bag out.bag");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("3 frames"), std::string::npos);
  EXPECT_NE(outcome.output.find("nothing moved"), std::string::npos);
  rosbag::Bag bag(path("out.bag"));
  std::map<std::string, int> counts;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) ++counts[instance.getTopic()];
  EXPECT_EQ(counts["/cabinet/rectangles"], 3);
  EXPECT_EQ(counts["/cabinet/models"], 3);
  EXPECT_GE(counts["/cabinet/tracks"], 3);
}

TEST_F(ProcessBag, ConvertsColour) {
  writeGrey("colour.bag", [](int, Frame& frame) {
    const cv::Mat3b colour(240, 320, cv::Vec3b(50, 100, 150));
    frame.left = imageOf(colour, frame.left.header.stamp, "bgr8");
    frame.right = imageOf(colour, frame.right.header.stamp, "bgr8");
  });
  const Outcome outcome = run("colour.bag out.bag");
  EXPECT_EQ(outcome.status, 0) << outcome.output;
}

TEST_F(ProcessBag, SaysWhatIsWrongWithAFile) {
  expectFailure("none.bag out.bag", "none.bag: cannot be opened: there is no such file");
  std::ofstream(path("text.bag")) << "this is no bag\n";
  expectFailure("text.bag out.bag", "text.bag: not a complete bag file");
  std::filesystem::create_directory(path("folder.bag"));
  expectFailure("folder.bag out.bag", "folder.bag: is a folder, expected an ordinary file");
  ASSERT_EQ(::mkfifo(path("pipe.bag").c_str(), 0600), 0);
  expectFailure("pipe.bag out.bag", "pipe.bag: is a pipe, expected an ordinary file");
  writeGrey("whole.bag");
  const std::string whole = bytes(path("whole.bag"));
  std::ofstream(path("cut.bag"), std::ios::binary) << whole.substr(0, whole.size() / 2);
  expectFailure("cut.bag out.bag", "rosbag reindex");
  EXPECT_FALSE(std::filesystem::exists(path("out.bag"))) << "nothing is written where nothing was read";
}

TEST_F(ProcessBag, SaysWhatIsWrongWithItsArguments) {
  writeGrey("grey.bag");
  expectFailure("grey.bag", "expected two bags");
  expectFailure("grey.bag out.bag --speed 3", "unknown option or missing value: --speed");
  expectFailure("grey.bag grey.bag", "same file");
  expectFailure("grey.bag out.bag --config none", "configuration directory 'none' does not exist");
  expectFailure("grey.bag none/out.bag", "cannot be written");
  EXPECT_EQ(run("--help").status, 0);
}

TEST_F(ProcessBag, ListsTheTopicsThereAre) {
  writeGrey("grey.bag");
  const Outcome outcome = run("grey.bag out.bag --input stereo --camera narrow");
  EXPECT_EQ(outcome.status, 1);
  for (const char* words : {"missing topics", "/narrow/left/image_raw (sensor_msgs/Image)", "/narrow/right/camera_info",
                            "in the bag are", "/stereo/left/image_raw (sensor_msgs/Image)"})
    EXPECT_NE(outcome.output.find(words), std::string::npos) << words << " in:\n" << outcome.output;
}

TEST_F(ProcessBag, SkipsPairsThatDoNotBelongTogether) {
  writeGrey("stamps.bag", [](int i, Frame& frame) {
    if (i == 1) frame.right.header.stamp += ros::Duration(0.01);
  });
  Outcome outcome = run("stamps.bag out.bag");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("2 frames of"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("skipped 1 frames: left image without a right image of the same stamp (first: 101."),
            std::string::npos)
      << outcome.output;

  writeGrey("sizes.bag", [](int i, Frame& frame) {
    if (i == 2) frame.right = imageOf(cv::Mat1b(120, 160, 100), frame.right.header.stamp);
  });
  outcome = run("sizes.bag out.bag");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("skipped 1 frames: left and right image and their CameraInfos differ in size"), std::string::npos)
      << outcome.output;
  EXPECT_NE(outcome.output.find("160x120"), std::string::npos);

  writeGrey("all.bag", [](int, Frame& frame) { frame.right.header.stamp += ros::Duration(0.01); });
  expectFailure("all.bag out.bag", "no frame could be processed");
}

TEST_F(ProcessBag, RefusesAnUncalibratedCamera) {
  writeGrey("baseline.bag", [](int, Frame& frame) { frame.right_info.P[3] = 0; });
  expectFailure("baseline.bag out.bag", "P[3]");
  writeGrey("focal.bag", [](int, Frame& frame) { frame.left_info.P[0] = frame.left_info.K[0] = 0; });
  expectFailure("focal.bag out.bag", "focal length");
}

TEST_F(ProcessBag, SkipsFramesWithoutTransform) {
  writeGrey("grey.bag");
  const Outcome outcome = run("grey.bag out.bag --fixed-frame world");
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.output.find("skipped 3 frames: no transform from 'left_optical' to 'world'"), std::string::npos)
      << outcome.output;
}

TEST_F(ProcessBag, StartsAnewWhereTimeWasSetBackAndSkipsWhatIsOutOfOrder) {
  const double seconds[] = {100, 101, 5};
  writeGrey("loop.bag", [&](int i, Frame& frame) {
    for (std_msgs::Header* header : {&frame.left.header, &frame.right.header}) header->stamp = ros::Time(seconds[i]);
  });
  Outcome outcome = run("loop.bag out.bag");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.output.find("3 frames of"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("time jumped back from 101.000000 to 5.000000"), std::string::npos) << outcome.output;

  writeGrey("order.bag", [&](int i, Frame& frame) {
    for (std_msgs::Header* header : {&frame.left.header, &frame.right.header}) header->stamp = ros::Time(i == 1 ? 99.5 : 100 + i);
  });
  outcome = run("order.bag out.bag");
  EXPECT_NE(outcome.output.find("2 frames of"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("skipped 1 frames: the stamp is not newer than the frame's before"), std::string::npos)
      << outcome.output;
}

}  // namespace
}  // namespace cabinet_articulation
