// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "cabinet_articulation/geometry/stereo_camera.h"
#include "cabinet_articulation/simulation/motion_script.h"
#include "cabinet_articulation/simulation/scene.h"
#include "cabinet_articulation/simulation/simulation_config.h"

namespace cabinet_articulation::core {

/// The exact state of one front, in the left optical frame of the same moment.
struct FrontTruth {
  std::string name;
  JointType type = JointType::kRigid;
  Rectangle rectangle;                                   ///< x along the width, y up along the height, z outward
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();        ///< as ArticulationModel.axis, now; zero if rigid
  Eigen::Vector3d axis_point = Eigen::Vector3d::Zero();  ///< a point on the axis (rotational)
  double q = 0;                                          ///< [m or rad] 0 = closed
  double q_max = 0;
  std::string parent = {};  ///< name of the front that carries it; empty: the world
};

struct GroundTruth {
  std::string scene;
  double time = 0;                                                   ///< [s] since the first frame
  bool last = false;                                                 ///< the motion script has ended
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();  ///< left optical frame
  std::vector<FrontTruth> joints;                                    ///< every front that can move
  std::vector<FrontTruth> fixed;                                     ///< rectangles that stand still
};

struct StereoFrame {
  cv::Mat1b left, right;  ///< rectified pair
  cv::Mat1f depth;        ///< [m] exact, of the left image; 0 = nothing
  GroundTruth truth;
};

/// An active stereo camera in front of a scene that moves by a script. Frame i shows the moment i / rate. A frame depends on
/// the configuration and its index alone: the same index gives the same bits in whatever order frames are asked for.
class SimulatedStereoCamera {
 public:
  /// Throws ConfigError.
  explicit SimulatedStereoCamera(const SimulationConfig& config);

  /// Any other scene and script, seen through the same rig.
  SimulatedStereoCamera(const SimulationConfig& config, Scene scene, MotionScript script);
  ~SimulatedStereoCamera();

  const StereoCamera& camera() const { return camera_; }

  /// Frames of one run of the motion script.
  int frameCount() const;

  /// Cheap: renders nothing.
  GroundTruth truth(int frame) const;

  StereoFrame frame(int frame);

 private:
  struct Rig;
  double scriptTime(int frame) const;
  Eigen::Isometry3d cameraPose(double time) const;

  SimulationConfig config_;
  Scene scene_;
  MotionScript script_;
  StereoCamera camera_;
  std::unique_ptr<Rig> rig_;
};

}  // namespace cabinet_articulation::core
