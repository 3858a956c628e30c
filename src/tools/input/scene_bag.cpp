// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/scene_bag.h"

#include <rosbag/bag.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <stdexcept>

#include "cabinet_articulation/ros/image_conversions.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "ros/messages/simulation_conversions.h"

namespace cabinet_articulation {
namespace {

class SceneBag {
 public:
  explicit SceneBag(const SceneBagConfig& config) : config_(config), camera_(config.simulation), matcher_(core::StereoConfig()) {
    header_.frame_id = config.optical_frame;
  }

  int writeAll(const std::string& path) {
    const int left = camera_.frameCount() - config_.first_frame;
    if (left < 1)
      throw std::invalid_argument("frame " + std::to_string(config_.first_frame) + " is not of the scene's motion, which has " +
                                  std::to_string(camera_.frameCount()) + " frames");
    const int count = config_.frames > 0 ? config_.frames : left;
    bag_.open(path, rosbag::bagmode::Write);
    for (int i = 0; i < config_.rounds * count; ++i) {
      recorded_ = timeOf(i);
      header_.stamp = timeOf(i % count);
      writeFrame(camera_.frame(config_.first_frame + i % count));
    }
    bag_.close();
    return config_.rounds * count;
  }

 private:
  ros::Time timeOf(int frame) const { return config_.start + ros::Duration(frame / config_.simulation.rate); }

  void writeFrame(const core::StereoFrame& frame) {
    writeTransform(frame.truth.T_world_camera);
    add("/truth", toMessage(frame.truth, header_, config_.world_frame));
    if (has("stereo") || has("disparity")) {
      add("/left/camera_info", toLeftCameraInfo(camera_.camera(), header_));
      add("/right/camera_info", toRightCameraInfo(camera_.camera(), header_));
    }
    if (has("stereo")) writePair(frame, "/image_raw");
    if (has("disparity")) {
      writePair(frame, "/image_rect");
      const core::StereoConfig& matching = matcher_.config();
      const core::DepthFrame matched = matcher_.process(frame.left, frame.right, camera_.camera());
      add("/disparity", toMessage(matched, header_, matching.min_disparity, matching.disparity_range));
    }
    if (has("depth")) {
      add("/depth/camera_info", toLeftCameraInfo(camera_.camera(), header_));
      add("/depth/image", *cv_bridge::CvImage(header_, "32FC1", frame.depth).toImageMsg());
    }
  }

  void writeTransform(const Eigen::Isometry3d& T_world_camera) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(tf2::eigenToTransform(T_world_camera));
    message.transforms[0].header.stamp = header_.stamp;
    message.transforms[0].header.frame_id = config_.world_frame;
    message.transforms[0].child_frame_id = config_.optical_frame;
    bag_.write("/tf", recorded_, message);
  }

  void writePair(const core::StereoFrame& frame, const std::string& name) {
    add("/left" + name, toMessage(frame.left, header_));
    add("/right" + name, toMessage(frame.right, header_));
  }

  template <class Message>
  void add(const std::string& topic, const Message& message) {
    bag_.write(config_.camera + topic, recorded_, message);
  }

  bool has(const std::string& input) const { return config_.inputs.count(input) > 0; }

  SceneBagConfig config_;
  core::SimulatedStereoCamera camera_;
  core::BlockMatcher matcher_;
  rosbag::Bag bag_;
  std_msgs::Header header_;
  ros::Time recorded_;
};

}  // namespace

int writeSceneBag(const std::string& path, const SceneBagConfig& config) {
  for (const std::string& input : config.inputs)
    if (input != "stereo" && input != "disparity" && input != "depth")
      throw std::invalid_argument("unknown input '" + input + "', expected stereo, disparity or depth");
  try {
    return SceneBag(config).writeAll(path);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + ": cannot be written (" + error.what() + ")");
  }
}

}  // namespace cabinet_articulation
