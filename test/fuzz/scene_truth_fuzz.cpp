// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "messages.h"
#include "model_uses.h"
#include "ros/messages/simulation_conversions.h"
#include "small_frame.h"
#include "tools/truth/truth_comparison.h"

using namespace cabinet_articulation;

namespace {

JointTruth truthOf(const core::LearnedModel& model) {
  const ArticulationModel message = toMessage(model, "map");
  JointTruth truth;
  truth.name = "front";
  truth.type = message.type;
  truth.pose = message.origin;
  truth.width = message.width;
  truth.height = message.height;
  truth.axis = message.axis;
  truth.axis_point = message.axis_point;
  truth.q = message.q;
  truth.q_max = message.q_max;
  return truth;
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  const std::vector<core::LearnedModel> models = modelsOf(exampleFronts());
  SceneTruth truth;
  truth.header = test::exampleHeader();
  truth.scene = "kitchen";
  truth.camera.header.frame_id = "map";
  truth.camera.pose = toMessage(test::facingCamera(1, 2, 3));
  truth.joints = {truthOf(models[0]), truthOf(models[1])};
  truth.fixed = {truthOf(test::restingModel())};
  return {{serialized(truth, toMessage(models, truth.header))}};
}

/// The simulation's truth beside models, as the reports of the demo get them.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::examineMessages(data, size, [](fuzz::MessageReader& reader) {
    const auto truth = reader.next<SceneTruth>();
    const auto models = reader.next<ArticulationModelArray>();
    TruthComparison comparison;
    comparison.add(*truth);
    comparison.add(inFrame(*truth, truth->camera.header.frame_id));
    format(comparison.compare(models->models, {}));
  });
}
