// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/live_models.h"
#include "bridge/original_learner.h"
#include "bridge/original_model.h"
#include "bridge/original_track.h"
#include "bridge/spanning_tree.h"
#include "cabinet_articulation/ros/conversions.h"
#include "messages.h"
#include "model_uses.h"
#include "support/ros_messages.h"

using namespace cabinet_articulation;
using articulation_msgs::ArticulatedObjectMsg;
using articulation_msgs::ModelMsg;

namespace {

constexpr char kSelect = 's', kFit = 'f', kEval = 'e', kPoses = 'p', kConfigurations = 'c', kResample = 'r', kStore = 'o';
constexpr char kTree = 't', kLive = 'l';

/// What the services on one model do; the answers are asked again.
void answer(char service, const ModelMsg& request) {
  bridge::OriginalLearner learner{core::ArticulationConfig()};
  if (service == kSelect) learner.select(request);
  if (service == kFit) learner.eval(learner.fit(request));
  if (service == kEval) learner.eval(learner.eval(request));
  if (service == kPoses) learner.configurationsToPoses(learner.posesToConfigurations(request));
  if (service == kConfigurations) learner.configurationsToPoses(request);
  if (service == kResample) learner.resampled(request);
  if (service != kStore) return;
  learner.store(request);
  learner.select(request);
  learner.setPrior(learner.prior());
}

void answerLive(fuzz::MessageReader* reader) {
  const auto tracks = reader->next<TrackArray>();
  const auto models = reader->next<ArticulationModelArray>();
  core::TrackAssembly fronts;
  fronts.add(fromMessage(*tracks));
  for (const core::Track& track : fronts.tracks()) bridge::toOriginal(track, tracks->header.frame_id);
  std::string left_out;
  bridge::originalModels(*models, fronts.tracks(), &left_out);
}

/// Every type of model, with the track that it explains.
std::vector<ModelMsg> models() {
  std::vector<ModelMsg> messages;
  for (const core::KnownFront& front : fuzz::hangingFronts()) {
    ModelMsg message;
    message.id = -1;
    message.track = bridge::toOriginal(front.track, "map");
    bridge::describe(front.model, bridge::fromOriginal(message.track).T_pose_center, &message);
    messages.push_back(message);
  }
  return messages;
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  Seeds seeds;
  ArticulatedObjectMsg object;
  for (const ModelMsg& model : models()) {
    for (const char service : {kSelect, kFit, kEval, kPoses, kResample, kStore})
      if (service != kFit || model.name != "nonparametric") seeds.valid.push_back(service + serialized(model));
    seeds.valid.push_back(kConfigurations + serialized(bridge::OriginalLearner(core::ArticulationConfig()).eval(model)));
    object.parts.push_back(model.track);
  }
  seeds.valid.push_back(kTree + serialized(object));
  const std::vector<core::KnownFront> fronts = hangingFronts();
  const std_msgs::Header header = test::exampleHeader();
  seeds.valid.push_back(kLive + serialized(toMessage(tracksOf(fronts), header), toMessage(core::modelsOf(fronts), header)));
  ModelMsg far = models().front();
  far.track.pose.front().position.x = 1e155;
  seeds.hostile = {kSelect + serialized(far), kStore + serialized(ModelMsg())};
  return seeds;
}

/// Requests and messages of the original release; the first byte says to what service or topic.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto service = static_cast<char>(data[0]);
  return fuzz::examineMessages<std::runtime_error>(data + 1, size - 1, [service](fuzz::MessageReader& reader) {
    if (service == kLive)
      answerLive(&reader);
    else if (service == kTree)
      bridge::spanningTree(*reader.next<ArticulatedObjectMsg>(), core::ArticulationConfig());
    else
      answer(service, *reader.next<ModelMsg>());
  });
}
