// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "tools/report/thinned.h"

namespace cabinet_articulation {

/// The camera's picture with everything drawn in, as JPEG.
struct Picture {
  double time = 0;  ///< [s] since the run's first frame
  std::vector<std::uint8_t> jpeg;
};

/// Collects pictures of frames: some at even steps, and those in which joints were told first. Memory is bounded.
class FramePictures {
 public:
  /// `new_joints` are the ids of those that this frame told first.
  void add(double time, const core::PipelineResult& result, const Eigen::Isometry3d& T_fixed_camera,
           const std::vector<std::uint32_t>& new_joints);

  std::vector<Picture> evenlySpaced() const { return evenly_spaced_.values(); }

  /// Null if there is none.
  const Picture* firstOf(std::uint32_t joint) const;

 private:
  static constexpr std::size_t kMostFrames = 15, kMostJoints = 128;  ///< some 10 MB (ours)

  Thinned<Picture> evenly_spaced_{kMostFrames};
  std::map<std::uint32_t, Picture> first_;
};

}  // namespace cabinet_articulation
