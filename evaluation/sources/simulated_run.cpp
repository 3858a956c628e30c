// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "sources/front_truth.h"
#include "sources/simulated_sources.h"

namespace cabinet_articulation::core::evaluation {
namespace {

class SimulatedRun : public FrameSource {
 public:
  explicit SimulatedRun(const SimulationConfig& config)
      : name_("simulated_" + config.scene + "_" + std::to_string(config.scene_seed) +
              (config.camera_motion > 0 ? "_moving" : "")),
        simulator_(config) {}

  const std::string& name() const override { return name_; }
  const StereoCamera& camera() const override { return simulator_.camera(); }
  int size() const override { return simulator_.frameCount(); }
  bool independent() const override { return false; }

  Frame frame(int index) override {
    const StereoFrame image = simulator_.frame(index);
    Frame frame{image.truth.time, image.truth.T_world_camera, image.left, image.right, {}, {}};
    for (const FrontTruth& truth : image.truth.joints) frame.fronts.push_back(makeFront(truth, image, camera()));
    return frame;
  }

 private:
  std::string name_;
  SimulatedStereoCamera simulator_;
};

}  // namespace

std::unique_ptr<FrameSource> simulateRun(const SimulationConfig& config) { return std::make_unique<SimulatedRun>(config); }

}  // namespace cabinet_articulation::core::evaluation
