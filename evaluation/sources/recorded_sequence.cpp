// SPDX-License-Identifier: BSD-3-Clause
#include "sources/recorded_sequence.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "geometry/message_precision.h"

namespace cabinet_articulation::core::evaluation {
namespace {

constexpr auto kUnlimited = std::numeric_limits<double>::infinity();

/// JSON is a subset of YAML.
YAML::Node load(const std::string& path) {
  try {
    return YAML::LoadFile(path);
  } catch (const YAML::Exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

StereoCamera readCamera(const YAML::Node& calibration) {
  const YAML::Node left = calibration["left"];
  if (!left || !calibration["right"]) throw std::runtime_error("holds no calibration of `left` and `right`");
  return StereoCamera::fromProjections(left["width"].as<int>(), left["height"].as<int>(), left["P"].as<std::array<double, 12>>(),
                                       calibration["right"]["P"].as<std::array<double, 12>>());
}

/// As tf would send it. What was rounded to be written is no rotation to the last digit, and the pipeline relies on one.
Eigen::Isometry3d readTransform(const YAML::Node& rows) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) T(r, c) = rows[r][c].as<double>();
  return asSent(T);
}

JointType readType(const std::string& type) {
  if (type == "prismatic") return JointType::kPrismatic;
  if (type == "rotational") return JointType::kRotational;
  return JointType::kRigid;
}

/// How far the moving edge of a front is from closed. `q` may be null for fronts without a joint.
double opened(const std::string& type, const YAML::Node& q, double width) {
  if (type == "free") return kUnlimited;
  if (type == "rigid" || q.IsNull()) return 0;
  return std::abs(q.as<double>()) * (type == "rotational" ? width : 1);
}

Front readFront(const YAML::Node& panel) {
  const auto center = panel["center"].as<std::array<double, 3>>();
  const auto xyzw = panel["orientation_xyzw"].as<std::array<double, 4>>();
  const auto type = panel["type"].as<std::string>();
  Front front;
  front.name = panel["name"].as<std::string>();
  front.type = readType(type);
  front.rectangle.width = panel["width"].as<double>();
  front.rectangle.height = panel["height"].as<double>();
  front.rectangle.pose.linear() = Eigen::Quaterniond(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized().toRotationMatrix();
  front.rectangle.pose.translation() = Eigen::Vector3d(center[0], center[1], center[2]);
  front.opened = opened(type, panel["q"], front.rectangle.width);
  front.visible = panel["visible_fraction"].as<double>(1);
  front.in_image = panel["in_image_fraction"].as<double>(1);
  front.faces_camera = panel["front_faces_camera"].as<bool>(true);
  return front;
}

class RecordedSequence : public FrameSource {
 public:
  explicit RecordedSequence(const std::string& folder) : folder_(folder) {
    while (folder_.size() > 1 && folder_.back() == '/') folder_.pop_back();
    name_ = folder_.substr(folder_.find_last_of('/') + 1);
    const std::string truth = folder_ + "/truth.json";
    camera_ = readCalibration();
    try {
      for (const YAML::Node& frame : load(truth)["frames"]) frames_.push_back(readTruth(frame));
    } catch (const YAML::Exception& error) {
      throw std::runtime_error(truth + ": " + error.what());
    }
  }

  const std::string& name() const override { return name_; }
  const StereoCamera& camera() const override { return camera_; }
  int size() const override { return static_cast<int>(frames_.size()); }

  Frame frame(int index) override {
    Frame frame = frames_.at(index);
    if (!std::filesystem::exists(file("left", 0)) && std::filesystem::exists(file("depth", 0))) {
      frame.depth = readImage<std::uint16_t>("depth", index, cv::IMREAD_UNCHANGED);
      return frame;
    }
    frame.left = readImage<std::uint8_t>("left", index, cv::IMREAD_GRAYSCALE);
    frame.right = readImage<std::uint8_t>("right", index, cv::IMREAD_GRAYSCALE);
    return frame;
  }

  bool independent() const override {
    for (const Frame& frame : frames_)
      for (const Front& front : frame.fronts)
        if (front.opened == kUnlimited) return true;
    return false;
  }

 private:
  StereoCamera readCalibration() const {
    const std::string file = folder_ + "/calibration.json", truth = folder_ + "/truth.json";
    const bool own_file = std::filesystem::exists(file);
    try {
      return readCamera(own_file ? load(file) : load(truth)["calibration"]);
    } catch (const std::exception& error) {
      throw std::runtime_error((own_file ? file : truth) + ": " + error.what());
    }
  }

  static Frame readTruth(const YAML::Node& node) {
    Frame frame;
    frame.stamp = node["stamp"].as<double>();
    frame.T_world_camera = readTransform(node["T_world_left"]);
    for (const YAML::Node& panel : node["panels"]) frame.fronts.push_back(readFront(panel));
    return frame;
  }

  std::string file(const char* kind, int index) const {
    char name[32];
    std::snprintf(name, sizeof(name), "/%s_%04d.png", kind, index);
    return folder_ + name;
  }

  template <class Value>
  cv::Mat_<Value> readImage(const char* kind, int index, int how) const {
    const cv::Mat image = cv::imread(file(kind, index), how);
    if (image.empty() || image.type() != cv::DataType<Value>::type)
      throw std::runtime_error("cannot read " + file(kind, index) + ", or not of " + std::to_string(8 * sizeof(Value)) + " bits");
    return image;
  }

  std::string folder_, name_;
  StereoCamera camera_;
  std::vector<Frame> frames_;  ///< without images
};

}  // namespace

std::unique_ptr<FrameSource> openRecordedSequence(const std::string& folder) {
  return std::make_unique<RecordedSequence>(folder);
}

}  // namespace cabinet_articulation::core::evaluation
