// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

#include <algorithm>
#include <cmath>

#include "simulation/cabinet_scenes.h"
#include "simulation/image_sensor.h"
#include "simulation/stereo_renderer.h"

namespace cabinet_articulation::core {
namespace {

const SimulationConfig& checked(const SimulationConfig& config) {
  checkConfig(config);
  return config;
}

/// Mostly short, and at times up to `longest`.
double mostlyShort(double longest, cv::RNG* random) { return longest * std::pow(random->uniform(0.0, 1.0), 3); }

constexpr double kBetweenMoves = 1.5;  ///< [s]

/// In turn as the scene says, each with its own speed, and from the second round on with its own width, stay and rest.
MotionScript makeScript(const SimulationConfig& config, const Scene& scene) {
  cv::RNG random(static_cast<std::uint64_t>(config.scene_seed) * 2 + 1);
  std::vector<Move> moves;
  double start = 1;
  for (int round = 0; round < config.rounds; ++round) {
    const size_t first = moves.size();
    for (size_t i = 0; i < scene.joints.size(); ++i) {
      if (scene.joints[i].turn == Turn::kWithPrevious) {
        moves.push_back(moves.back());
        moves.back().joint = static_cast<int>(i);
        moves.back().q_max *= scene.joints[i].q_max / scene.joints[i - 1].q_max;
        continue;
      }
      Move move;
      move.joint = static_cast<int>(i);
      move.q_max = scene.joints[i].q_max;
      move.start = start;
      move.opening *= random.uniform(0.85, 1.15);
      move.closing *= random.uniform(0.85, 1.15);
      if (round > 0) {
        move.q_max *= random.uniform(0.4, 1.0);
        move.pause = 0.2 + mostlyShort(8, &random);
        move.start += mostlyShort(20, &random);
      }
      moves.push_back(move);
      start = (scene.joints[i].turn == Turn::kAroundOthers ? move.start + move.opening : move.end()) + kBetweenMoves;
    }
    for (size_t i = moves.size(); i-- > first;) {
      Move& move = moves[i];
      if (scene.joints[i - first].turn != Turn::kAroundOthers) continue;
      move.pause = std::max(move.pause, start - move.start - move.opening);
      start = move.end() + kBetweenMoves;
    }
  }
  return MotionScript(moves);
}

StereoCamera makeCamera(const SimulationConfig& config) {
  StereoCamera camera;
  camera.width = config.width;
  camera.height = config.height;
  camera.fx = camera.fy = config.focal_length;
  // Not the image's centre, as in every real camera: who uses the centre by mistake is found out.
  camera.cx = config.width / 2.0 + 2.25;
  camera.cy = config.height / 2.0 - 3.5;
  camera.baseline = config.baseline;
  return camera;
}

}  // namespace

struct SimulatedStereoCamera::Rig {
  Rig(const SimulationConfig& config, const StereoCamera& camera) : renderer(config, camera), sensor(config) {}
  StereoRenderer renderer;
  ImageSensor sensor;
};

SimulatedStereoCamera::SimulatedStereoCamera(const SimulationConfig& config)
    : SimulatedStereoCamera(checked(config), makeScene(config), makeScript(config, makeScene(config))) {}

SimulatedStereoCamera::SimulatedStereoCamera(const SimulationConfig& config, Scene scene, MotionScript script)
    : config_(checked(config)),
      scene_(std::move(scene)),
      script_(std::move(script)),
      camera_(makeCamera(config_)),
      rig_(std::make_unique<Rig>(config_, camera_)) {}

SimulatedStereoCamera::~SimulatedStereoCamera() = default;

int SimulatedStereoCamera::frameCount() const { return static_cast<int>(std::floor(script_.duration() * config_.rate)) + 1; }

double SimulatedStereoCamera::scriptTime(int frame) const {
  const int index = config_.loop ? frame % frameCount() : std::min(frame, frameCount() - 1);
  return index / config_.rate;
}

Eigen::Isometry3d SimulatedStereoCamera::cameraPose(double time) const {
  // Periods without a common measure, so that the path does not repeat within a run.
  const Eigen::Vector3d wander(std::sin(0.9 * time), 0.5 * std::sin(0.67 * time + 1), 0.6 * std::sin(0.53 * time + 2));
  return lookAt(scene_.view_point + config_.camera_motion * wander, scene_.view_target);
}

GroundTruth SimulatedStereoCamera::truth(int frame) const {
  GroundTruth truth;
  truth.scene = scene_.name;
  truth.time = frame / config_.rate;
  const double script_time = scriptTime(frame);
  truth.last = !config_.loop && frame >= frameCount() - 1;
  truth.T_world_camera = cameraPose(truth.time);
  const Eigen::Isometry3d T_camera_world = truth.T_world_camera.inverse();
  std::vector<double> q;
  for (size_t i = 0; i < scene_.joints.size(); ++i) q.push_back(script_.q(static_cast<int>(i), script_time));
  const std::vector<Eigen::Isometry3d> motions = scene_.motionsAt(q);
  for (size_t i = 0; i < scene_.joints.size(); ++i) {
    const Joint& joint = scene_.joints[i];
    FrontTruth front{joint.name, joint.type, joint.front, {}, {}, q[i], joint.q_max};
    front.rectangle.pose = T_camera_world * motions[i] * joint.front.pose;
    Eigen::Isometry3d T_camera_base = T_camera_world;
    if (joint.parent != kFixedPart) {
      T_camera_base = T_camera_world * motions[static_cast<size_t>(joint.parent)];
      front.parent = scene_.joints[static_cast<size_t>(joint.parent)].name;
    }
    front.axis = T_camera_base.linear() * joint.axis;
    front.axis_point = T_camera_base * joint.axis_point;
    truth.joints.push_back(front);
  }
  for (const FixedFront& fixed : scene_.fixed) {
    FrontTruth front;
    front.name = fixed.name;
    front.rectangle = fixed.rectangle;
    front.rectangle.pose = T_camera_world * fixed.rectangle.pose;
    truth.fixed.push_back(front);
  }
  return truth;
}

StereoFrame SimulatedStereoCamera::frame(int frame) {
  StereoFrame result;
  result.truth = truth(frame);
  std::vector<double> q;
  for (const FrontTruth& joint : result.truth.joints) q.push_back(joint.q);
  std::vector<Surface> surfaces = scene_.surfacesAt(q);
  const std::optional<HandState> hand = config_.hand ? script_.hand(scriptTime(frame)) : std::nullopt;
  if (hand) {
    constexpr double kWithdrawn = 0.6;  // [m] along the arm, out of the way
    const auto held = static_cast<size_t>(hand->joint);
    const Eigen::Vector3d grip = scene_.motionsAt(q)[held] * scene_.joints[held].grip;
    const Eigen::Vector3d to_shoulder = (scene_.shoulder - grip).normalized();
    const std::vector<Surface> arm = makeArm(grip + hand->away * kWithdrawn * to_shoulder, scene_.shoulder);
    surfaces.insert(surfaces.end(), arm.begin(), arm.end());
  }
  const Eigen::Isometry3d T_camera_world = result.truth.T_world_camera.inverse();
  for (Surface& surface : surfaces) surface.rectangle.pose = T_camera_world * surface.rectangle.pose;
  const RenderedPair& pair = rig_->renderer.render(surfaces);
  const double gain = rig_->sensor.automaticGain(pair.left);
  const std::uint64_t stream = 2 * static_cast<std::uint64_t>(frame);
  result.left = rig_->sensor.expose(pair.left, gain, stream);
  result.right = rig_->sensor.expose(pair.right, gain, stream + 1);
  result.depth = pair.depth.clone();
  return result;
}

}  // namespace cabinet_articulation::core
