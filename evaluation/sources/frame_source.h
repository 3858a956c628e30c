// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "articulation/models/articulation_model.h"
#include "cabinet_articulation/geometry/rectangle.h"
#include "cabinet_articulation/geometry/stereo_camera.h"

namespace cabinet_articulation::core::evaluation {

/// The truth about one front in one frame.
struct Front {
  std::string name;
  JointType type = JointType::kRigid;
  Rectangle rectangle;  ///< in the left optical frame, z outward
  double opened = 0;    ///< [m] how far its moving edge is from closed; infinite for a front that hangs free
  double visible = 1;   ///< share that the left camera sees, after occlusion and image border
  double in_image = 1;  ///< share inside the left image
  bool faces_camera = true;
};

struct Frame {
  double stamp = 0;  ///< [s]
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  cv::Mat1b left, right;
  cv::Mat1w depth;            ///< [mm] of a depth camera in place of the pair; empty: there is a pair
  std::vector<Front> fronts;  ///< the same ones in the same order in every frame

  void releaseImages() {
    left.release();
    right.release();
    depth.release();
  }
};

/// Stereo pairs or depth images with ground truth, from the simulator or from a folder. A frame depends on its index alone.
class FrameSource {
 public:
  virtual ~FrameSource() = default;

  virtual const std::string& name() const = 0;
  virtual const StereoCamera& camera() const = 0;
  virtual int size() const = 0;
  virtual Frame frame(int index) = 0;

  /// True if successive frames show unrelated poses, so that nothing can be tracked.
  virtual bool independent() const = 0;
};

using SourceFactory = std::function<std::unique_ptr<FrameSource>()>;

}  // namespace cabinet_articulation::core::evaluation
