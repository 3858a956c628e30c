// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/config/config.h"

namespace cabinet_articulation {

/// How the two images of a pair find each other.
struct SyncConfig {
  bool approximate_sync = false;
  double sync_tolerance = 0.01;  ///< [s]

  double tolerance() const { return approximate_sync ? sync_tolerance : 0; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("approximate_sync", self.approximate_sync,
          "pair left and right images whose stamps differ (cameras without a common trigger)");
    visit("sync_tolerance", self.sync_tolerance, core::Range{0, 0.5}, "s",
          "largest difference of the stamps in an approximate pair");
  }
};

/// How images come.
struct ImageTransportConfig {
  std::string image_transport = "raw";

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("image_transport", self.image_transport, core::Choices{},
          "how images are sent: raw, compressed or compressedDepth, or another plugin that is installed");
  }
};

/// Where the depth comes from.
struct FrameInputConfig {
  std::string input = "disparity";
  double virtual_baseline = 0.075;  ///< [m]
  double depth_scale = 0.001;       ///< [m]

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("input", self.input, core::Choices{"disparity", "depth"},
          "topics to subscribe to: disparity (and its images) or depth");
    visit("virtual_baseline", self.virtual_baseline, core::Range{0.01, 1}, "m",
          "depth camera: baseline of the pair it is treated as (Kinect: 0.075)");
    visit("depth_scale", self.depth_scale, core::Range{1e-6, 0.1}, "m",
          "depth camera: the unit of 16 bit images (ROS: 0.001); floating point images are in metres");
  }
};

}  // namespace cabinet_articulation
