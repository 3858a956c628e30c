// SPDX-License-Identifier: BSD-3-Clause
// Watches a simulated drawer through the pipeline, and says what was learned beside what is true.
#include <ros/package.h>

#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/joints/urdf.h"
#include "cabinet_articulation/pipeline/pipeline.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"

namespace core = cabinet_articulation::core;

int main() {
  core::SimulationConfig scene;
  scene.scene = "drawer";
  scene.rate = 5;
  core::SimulatedStereoCamera camera(scene);

  std::vector<std::string> warnings;
  const std::string config = ros::package::getPath("cabinet_articulation") + "/config";
  core::Pipeline pipeline(core::PipelineConfig::load(config, &warnings));
  for (const std::string& warning : warnings) std::cerr << warning << '\n';

  // Until the drawer is wide open.
  core::PipelineResult result;
  core::FrontTruth drawer;
  for (int i = 0; i < camera.frameCount(); ++i) {
    const core::StereoFrame frame = camera.frame(i);
    if (frame.truth.joints[0].q < drawer.q) break;
    drawer = frame.truth.joints[0];
    result = pipeline.process(frame.truth.time, frame.left, frame.right, camera.camera());
  }
  std::printf("%zu planes; the drawer is %.3f m open\n", result.planes.size(), drawer.q);

  std::vector<core::LearnedModel> joints;
  for (const core::LearnedModel& model : result.models) {
    if (!core::isJoint(model)) continue;
    joints.push_back(model);
    const cabinet_articulation::ArticulationModel message = cabinet_articulation::toMessage(model, "camera");
    const Eigen::Vector3d error = model.predict(message.q).translation() - drawer.rectangle.center();
    std::printf("a joint of type %d, its front %.4f m beside the drawer's\n", message.type, error.norm());
  }
  std::cout << core::toUrdf(joints, "camera", "kitchen");
}
