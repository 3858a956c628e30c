// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/config/config.h"
#include "ros/input/input_settings.h"

/*
 * What can be set at a nodelet besides the configuration of its stage. In one place, so that the documentation is printed from
 * the same lists.
 */

namespace cabinet_articulation {

/// Settings that every stage has besides its own.
struct StageSettings {
  bool lazy = true;
  double diagnostic_period = 1;  ///< [s]

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("lazy", self.lazy, "work only while somebody subscribes to the results");
    visit("diagnostic_period", self.diagnostic_period, core::Range{0.05, 60}, "s",
          "how often the state is published on /diagnostics");
  }
};

/// Where tracks rest.
struct FixedFrameConfig {
  std::string fixed_frame;
  double transform_timeout = 0.2;  ///< [s]

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("fixed_frame", self.fixed_frame, core::Choices{},
          "tf frame in which the furniture rests; empty: the camera's, which then must rest");
    visit("transform_timeout", self.transform_timeout, core::Range{0, 5}, "s",
          "how long a frame waits for its transform (wall time)");
  }
};

/// Where what was learned outlives a restart.
struct ModelFileConfig {
  std::string models_file;
  bool save_at_exit = false;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("models_file", self.models_file, core::Choices{},
          "YAML file of learned models: loaded at the start if it is there, and the default of save_models and load_models");
    visit("save_at_exit", self.save_at_exit, "save the models to models_file when the nodelet ends");
  }
};

/// Where what was learned of a depth camera outlives a restart.
struct BendFileConfig {
  std::string bend_file;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("bend_file", self.bend_file, core::Choices{},
          "YAML file of how depth cameras bend what is flat: read at the start if it is there, saved at the end; empty: none");
  }
};

/// What the joints are published for.
struct FrameOutputConfig {
  bool publish_tf = true;
  std::string joint_zero = "first";

  bool countsFromClosed() const { return joint_zero == "closed"; }

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("publish_tf", self.publish_tf,
          "send the joints' frames; false where a robot_state_publisher does so from the exported URDF");
    visit("joint_zero", self.joint_zero, core::Choices{"first", "closed"},
          "where joint states, tf and URDF count from: the first observed position, or the closed one; then without joints that "
          "were not seen closed");
  }
};

/// Of the simulated camera, besides the scene.
struct SimulatedCameraSettings {
  std::string frame_id = "stereo_left_optical_frame";
  std::string world_frame = "world";
  bool wait_for_subscribers = false;
  std::string pace = "time";

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("frame_id", self.frame_id, core::Choices{}, "frame of the images and of the truth");
    visit("world_frame", self.world_frame, core::Choices{}, "tf of the camera is published in this frame; empty: no tf");
    visit("wait_for_subscribers", self.wait_for_subscribers,
          "nothing moves before both images have subscribers, so that they see the whole motion");
    visit("pace", self.pace, core::Choices{"time", "results"},
          "when a frame comes: time (1 / rate after the last, as from a camera) or results (when the topic models has those of "
          "the last; sends /clock, and needs use_sim_time)");
  }
};

}  // namespace cabinet_articulation
