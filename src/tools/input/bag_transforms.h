// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rosbag/bag.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <memory>
#include <string>

namespace cabinet_articulation {

/// All transforms of a bag, read ahead, so that a frame never waits for tf.
class BagTransforms {
 public:
  explicit BagTransforms(const rosbag::Bag& bag);

  /// Throws tf2::TransformException, in words, if the bag does not say where `source` was at `stamp`.
  Eigen::Isometry3d lookup(const std::string& target, const std::string& source, const ros::Time& stamp) const;

  /// The last transform that was left out, and why; empty if all are used.
  const std::string& leftOut() const { return left_out_; }

 private:
  std::unique_ptr<tf2::BufferCore> buffer_;
  std::string left_out_;
};

}  // namespace cabinet_articulation
