// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <opencv2/core.hpp>

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "geometry/degrees.h"
#include "sources/front_truth.h"
#include "sources/simulated_sources.h"

namespace cabinet_articulation::core::evaluation {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kWallReflectance = 0.6, kFloorReflectance = 0.35;

/// Wall and floor as a camera at height `eye` sees them.
Scene makeRoom(double wall, double eye) {
  Scene scene;
  Rectangle back;
  back.pose.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  back.pose.translation() = Vector3d(0, wall, 1.5);
  back.width = 8;
  back.height = 3;
  Rectangle floor;
  floor.pose.translation() = Vector3d(0, wall - 4, 0);
  floor.width = floor.height = 8;
  scene.surfaces = {{back, kWallReflectance, kFixedPart}, {floor, kFloorReflectance, kFixedPart}};
  scene.view_point = Vector3d(0, 0, eye);
  scene.view_target = scene.view_point + Vector3d::UnitY();
  return scene;
}

/// Scenes that stand still and show one front each.
class SingleFronts : public FrameSource {
 public:
  explicit SingleFronts(const std::string& name) : name_(name), camera_(SimulatedStereoCamera(SimulationConfig()).camera()) {}

  const std::string& name() const override { return name_; }
  const StereoCamera& camera() const override { return camera_; }
  bool independent() const override { return true; }

  Frame frame(int index) override {
    SimulationConfig config;
    config.noise_seed = index;
    SimulatedStereoCamera simulator(config, makeScene(index), MotionScript({}));
    const StereoFrame image = simulator.frame(0);
    Frame frame{index / config.rate, image.truth.T_world_camera, image.left, image.right, {}, {}};
    frame.fronts = {makeFront(image.truth.fixed.at(0), image, camera_)};
    frame.fronts[0].opened = std::numeric_limits<double>::infinity();
    return frame;
  }

 protected:
  virtual Scene makeScene(int index) const = 0;

 private:
  std::string name_;
  StereoCamera camera_;
};

class HangingDrawer : public SingleFronts {
 public:
  HangingDrawer(int poses, int seed) : SingleFronts("simulated_hanging_drawer"), poses_(poses), seed_(seed) {}

  int size() const override { return poses_; }

 private:
  static constexpr double kWidth = 0.395, kHeight = 0.125;  // paper, IV-B

  Scene makeScene(int index) const override {
    cv::RNG random(static_cast<std::uint64_t>(seed_) << 32 | static_cast<std::uint32_t>(index + 1));
    for (int i = 0; i < 10; ++i) random.next();  // neighbouring seeds start alike
    const double wall = random.uniform(3.9, 4.3);
    Scene scene = makeRoom(wall, random.uniform(1.0, 1.2));
    scene.view_target.z() -= random.uniform(0.05, 0.15);
    addFurniture(wall, &random, &scene);
    const Isometry3d T_world_camera = lookAt(scene.view_point, scene.view_target);
    Rectangle front;
    front.width = kWidth;
    front.height = kHeight;
    do {
      front.pose = T_world_camera * randomPose(&random);
    } while (!isAllowed(front, T_world_camera));
    addDrawer(front, random.uniform(0.4, 0.8), &scene);
    scene.fixed = {{"drawer", front}};
    return scene;
  }

  static void addFurniture(double wall, cv::RNG* random, Scene* scene) {
    for (const double side : {-1.0, 1.0}) {
      const double x = side * random->uniform(0.2, 1.2), half = random->uniform(0.2, 0.5);
      addBox(boxBetween({x - half, wall - random->uniform(0.3, 0.5), 0}, {x + half, wall, random->uniform(0.5, 1.5)}),
             random->uniform(0.2, 0.7), kFixedPart, &scene->surfaces);
    }
  }

  /// In the left optical frame.
  Isometry3d randomPose(cv::RNG* random) const {
    const double depth = random->uniform(0.6, 3.0);
    const Vector3d ray = camera().ray(random->uniform(0.0, 1.0) * camera().width, random->uniform(0.0, 1.0) * camera().height);
    const double tilt = random->uniform(10.0, 50.0) * kDegree, azimuth = random->uniform(0.0, 360.0) * kDegree;
    const double roll = random->uniform(-40.0, 40.0) * kDegree;
    Eigen::Matrix3d facing;  // x to the right, y up, z towards the camera
    facing << 1, 0, 0, 0, -1, 0, 0, 0, -1;
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() = Eigen::Quaterniond::FromTwoVectors(-Vector3d::UnitZ(), -ray).toRotationMatrix() * facing *
                    Eigen::AngleAxisd(tilt, Vector3d(std::cos(azimuth), std::sin(azimuth), 0)).toRotationMatrix() *
                    Eigen::AngleAxisd(roll, Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = depth * ray;
    return pose;
  }

  /// Above the floor, and every corner in both images, as in the paper's evaluation.
  bool isAllowed(const Rectangle& front, const Isometry3d& T_world_camera) const {
    for (const Vector3d& corner : front.corners()) {
      const Vector3d p = T_world_camera.inverse() * corner;
      if (corner.z() < 0.05 || p.z() < 0.4) return false;
      const Eigen::Vector2d pixel = camera().project(p);
      const double u_right = pixel.x() - camera().disparity(p.z());
      if (u_right < 0 || pixel.x() > camera().width - 1 || pixel.y() < 0 || pixel.y() > camera().height - 1) return false;
    }
    return true;
  }

  /// Front, handle and the box behind it, open at the top.
  static void addDrawer(const Rectangle& front, double reflectance, Scene* scene) {
    const auto add = [&](const Vector3d& a, const Vector3d& b, double material) {
      Box box = boxBetween(a, b);
      box.pose = front.pose * box.pose;
      addBox(box, material, kFixedPart, &scene->surfaces);
    };
    const double x = kWidth / 2, y = kHeight / 2;
    add({-x, -y, -0.018}, {x, y, 0}, reflectance);
    add({-0.07, -0.006, 0.022}, {0.07, 0.006, 0.034}, 0.3);
    constexpr double kBodyReflectance = 0.5, kBack = -0.32;
    const double inner = x - 0.025, low = -y + 0.012, high = y - 0.03;
    add({-inner, low, kBack}, {inner, low + 0.012, -0.018}, kBodyReflectance);
    add({-inner, low, kBack}, {inner, high, kBack + 0.012}, kBodyReflectance);
    add({-inner, low, kBack}, {-inner + 0.012, high, -0.018}, kBodyReflectance);
    add({inner - 0.012, low, kBack}, {inner, high, -0.018}, kBodyReflectance);
  }

  int poses_;
  int seed_;
};

class Board : public SingleFronts {
 public:
  Board(const std::string& name, double reflectance, const std::vector<double>& distances)
      : SingleFronts(name), reflectance_(reflectance), distances_(distances) {}

  int size() const override { return static_cast<int>(distances_.size()); }

 private:
  Scene makeScene(int index) const override {
    Scene scene = makeRoom(4.2, 1.3);
    cv::RNG random(index + 1);
    const auto turn = [&random] { return random.uniform(-1.0, 1.0) * kDegree; };
    Rectangle front;
    front.pose.linear() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    front.pose.linear() = front.pose.linear() * Eigen::AngleAxisd(turn(), Vector3d::UnitX()).toRotationMatrix() *
                          Eigen::AngleAxisd(turn(), Vector3d::UnitY()).toRotationMatrix();
    front.pose.translation() = scene.view_point + distances_.at(index) * Vector3d::UnitY();
    front.width = 1.6;
    front.height = 1.2;
    scene.surfaces.push_back({front, reflectance_, kFixedPart});
    scene.fixed = {{"board", front}};
    return scene;
  }

  double reflectance_;
  std::vector<double> distances_;
};

}  // namespace

std::unique_ptr<FrameSource> simulateHangingDrawer(int poses, int seed) { return std::make_unique<HangingDrawer>(poses, seed); }

std::unique_ptr<FrameSource> simulateBoard(const std::string& name, double reflectance, const std::vector<double>& distances) {
  return std::make_unique<Board>(name, reflectance, distances);
}

}  // namespace cabinet_articulation::core::evaluation
