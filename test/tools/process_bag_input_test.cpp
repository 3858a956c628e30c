// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/RectangleArray.h>
#include <rosbag/view.h>

#include <map>
#include <memory>
#include <vector>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "tools/stereo_bag_fixture.h"

namespace cabinet_articulation {
namespace {

/// The rectangles in a bag of results, as bytes, by stamp.
std::map<ros::Time, std::vector<std::uint8_t>> rectanglesIn(const std::string& path) {
  std::map<ros::Time, std::vector<std::uint8_t>> result;
  rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery("/cabinet/rectangles"))) {
    RectangleArray rectangles = *instance.instantiate<RectangleArray>();
    std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(rectangles));
    ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::serialize(stream, rectangles);
    result[rectangles.header.stamp] = bytes;
  }
  return result;
}

class ProcessBagInput : public StereoBagFixture {
 protected:
  static constexpr int kFrames = 4;
  static constexpr int kFirst = 12;  ///< by then the door stands open

  ProcessBagInput() {
    config_.scene = "door";
    config_.rate = 3;
    simulation_ = std::make_unique<core::SimulatedStereoCamera>(config_);
  }

  /// What the stereo nodelet would publish, in the given order, below /camera.
  void writeDisparities(const std::string& name, bool images_first) const {
    const core::StereoCamera& camera = simulation_->camera();
    core::BlockMatcher matcher{core::StereoConfig()};
    rosbag::Bag bag(path(name), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      const core::StereoFrame frame = simulation_->frame(kFirst + i);
      const ros::Time stamp(100 + i / config_.rate), later = stamp + ros::Duration(0.1);
      const sensor_msgs::Image left = imageOf(frame.left, stamp), right = imageOf(frame.right, stamp);
      bag.write("/camera/left/image_rect", images_first ? stamp : later, left);
      bag.write("/camera/right/image_rect", images_first ? stamp : later, right);
      bag.write("/camera/left/camera_info", later, infoOf(camera, false, stamp));
      bag.write("/camera/right/camera_info", later, infoOf(camera, true, stamp));
      const core::DepthFrame depth = matcher.process(frame.left, frame.right, camera);
      bag.write("/camera/disparity", images_first ? later : stamp,
                toMessage(depth, left.header, matcher.config().min_disparity, matcher.config().disparity_range));
    }
  }

  /// 16UC1 millimetres, and beside them a colour image of the same camera.
  void writeDepth(const std::string& name, const std::string& topic) const {
    const core::StereoCamera& camera = simulation_->camera();
    core::BlockMatcher matcher{core::StereoConfig()};
    rosbag::Bag bag(path(name), rosbag::bagmode::Write);
    for (int i = 0; i < kFrames; ++i) {
      const core::StereoFrame frame = simulation_->frame(kFirst + i);
      const ros::Time stamp(100 + i / config_.rate);
      const cv::Mat1f disparity = matcher.process(frame.left, frame.right, camera).disparity;
      cv::Mat1w millimetres(disparity.size(), 0);
      for (int v = 0; v < disparity.rows; ++v)
        for (int u = 0; u < disparity.cols; ++u)
          if (disparity(v, u) > 0) millimetres(v, u) = static_cast<std::uint16_t>(1000 * camera.depth(disparity(v, u)));
      bag.write(topic, stamp, imageOf(millimetres, stamp, "16UC1"));
      bag.write(topic.substr(0, topic.rfind('/')) + "/camera_info", stamp, infoOf(camera, false, stamp));
      bag.write("/camera/rgb/image_raw", stamp, imageOf(cv::Mat3b(480, 640, cv::Vec3b(1, 2, 3)), stamp, "bgr8"));
      bag.write("/camera/rgb/camera_info", stamp, infoOf(camera, false, stamp));
    }
  }

  void expectFrames(const std::string& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find(std::to_string(kFrames) + " frames of"), std::string::npos) << outcome.output;
  }

  core::SimulationConfig config_;
  std::unique_ptr<core::SimulatedStereoCamera> simulation_;
};

TEST_F(ProcessBagInput, DisparitiesGiveTheSameBitsAsTheStereoPairsTheyCameFrom) {
  rosbag::Bag bag(path("pairs.bag"), rosbag::bagmode::Write);
  for (int i = 0; i < kFrames; ++i) {
    const ros::Time stamp(100 + i / config_.rate);
    const core::StereoFrame frame = simulation_->frame(kFirst + i);
    write(bag,
          {imageOf(frame.left, stamp), imageOf(frame.right, stamp), infoOf(simulation_->camera(), false, stamp),
           infoOf(simulation_->camera(), true, stamp)},
          stamp);
  }
  bag.close();
  expectFrames("pairs.bag pairs_out.bag");
  const auto expected = rectanglesIn(path("pairs_out.bag"));
  ASSERT_GT(expected.begin()->second.size(), 200u) << "or this test shows nothing";
  for (const bool images_first : {true, false}) {
    writeDisparities("disparities.bag", images_first);
    expectFrames("disparities.bag out.bag --input disparity --camera camera");
    EXPECT_EQ(rectanglesIn(path("out.bag")), expected) << (images_first ? "images first" : "disparities first");
  }
  expectFrames("disparities.bag out.bag --input disparity");
}

TEST_F(ProcessBagInput, DepthIsFoundByTypeWhereOnlyOneFits) {
  writeDepth("named.bag", "/stereo/depth/image");
  expectFrames("named.bag named_out.bag --input depth");
  EXPECT_GT(rectanglesIn(path("named_out.bag")).begin()->second.size(), 200u);
  writeDepth("other.bag", "/camera/depth/image_raw");
  expectFrames("other.bag other_out.bag --input depth");
  EXPECT_EQ(rectanglesIn(path("other_out.bag")), rectanglesIn(path("named_out.bag")));
}

TEST_F(ProcessBagInput, SaysWhatIsMissing) {
  writeDepth("depth.bag", "/camera/depth/image_raw");
  expectFrames("depth.bag out.bag --input depth --camera camera");
  expectFailure("depth.bag out.bag --input depth --camera front",
                "missing topics:\n  /front/depth/camera_info (sensor_msgs/CameraInfo)\n  /front/depth/image (sensor_msgs/Image)");
  expectFailure("depth.bag out.bag --input disparity",
                "missing topics:\n  /stereo/left/camera_info (sensor_msgs/CameraInfo)\n"
                "  /stereo/disparity (stereo_msgs/DisparityImage)\nin the bag are:");
  expectFailure("depth.bag out.bag --input stereo", "/camera/depth/image_raw (sensor_msgs/Image)");
  expectFailure("depth.bag out.bag --input sound", "input is 'sound', expected stereo, disparity or depth");
}

TEST_F(ProcessBagInput, AsksWhichOfSeveralItIs) {
  writeDepth("two.bag", "/front/depth/image");
  rosbag::Bag bag(path("two.bag"), rosbag::bagmode::Append);
  bag.write("/back/depth/image", ros::Time(100), imageOf(cv::Mat1w(480, 640, 1000), ros::Time(100), "16UC1"));
  bag.write("/back/depth/camera_info", ros::Time(100), infoOf(simulation_->camera(), false, ros::Time(100)));
  bag.close();
  expectFailure(
      "two.bag out.bag --input depth",
      "2 inputs fit, choose one:\n  --input depth --depth-image /back/depth/image\n  --input depth --depth-image /front/");
  expectFrames("two.bag out.bag --input depth --camera front");
  expectFrames("two.bag out.bag --depth-image front/depth/image");
}

TEST_F(ProcessBagInput, SkipsMessagesThatCannotBeUsed) {
  writeDepth("depth.bag", "/stereo/depth/image");
  rosbag::Bag bag(path("depth.bag"), rosbag::bagmode::Append);
  bag.write("/stereo/depth/image", ros::Time(200), imageOf(cv::Mat1w(120, 160, 1000), ros::Time(200), "16UC1"));
  bag.close();
  const Outcome outcome = run("depth.bag out.bag --input depth");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(
      outcome.output.find("skipped 1 frames: messages that cannot be used (first: /stereo/depth/image: the depth image is "),
      std::string::npos)
      << outcome.output;
}

}  // namespace
}  // namespace cabinet_articulation
