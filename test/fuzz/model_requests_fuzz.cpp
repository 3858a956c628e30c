// SPDX-License-Identifier: BSD-3-Clause
#include <cabinet_articulation/Configuration.h>
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/HandlePath.h>
#include <cabinet_articulation/Predict.h>
#include <cabinet_articulation/SetName.h>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/joints/prediction.h"
#include "cabinet_articulation/joints/urdf.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "joints/learned_fronts.h"
#include "messages.h"
#include "model_uses.h"
#include "ros/answers/model_answers.h"
#include "small_frame.h"

using namespace cabinet_articulation;

namespace {

constexpr char kPredict = 'p', kConfiguration = 'c', kHandlePath = 'h', kExportUrdf = 'u', kSetName = 'n';
constexpr char kEvaluate = 'e', kProjectPoses = 'x', kProjectConfigurations = 'q';

const core::LearnedModel& modelOf(std::uint32_t id) {
  static const core::KnownFronts known = [] {
    core::KnownFronts fronts;
    fronts.replace(fuzz::exampleFronts());
    return fronts;
  }();
  return known.at(id);
}

void answer(const Predict::Request& request) {
  core::requireAtMost("openings in q", request.q.size(), core::limits::kMostEntries);
  for (const double q : request.q) core::predictWithCovariance(modelOf(request.id), q);
}

void answer(const Configuration::Request& request) { core::findConfiguration(modelOf(request.id), fromMessage(request.pose)); }

void answer(const HandlePath::Request& request) {
  geometry_msgs::Pose grasp;
  grasp.position = request.grasp_point;
  grasp.orientation = request.grasp_orientation;
  core::handlePath(modelOf(request.id), fromMessage(grasp), request.q_from, request.q_to, static_cast<int>(request.steps));
}

void answer(const ExportUrdf::Request& request) {
  core::requireAtMost("ids", request.ids.size(), core::limits::kMostEntries);
  std::vector<core::LearnedModel> models;
  for (const std::uint32_t id : request.ids) models.push_back(modelOf(id));
  core::toUrdf(models, "map", "cabinet");
}

/// A name that is taken is known to be good for the description, and a proposal is never refused.
void answer(const SetName::Request& request) {
  core::KnownFronts known;
  known.replace(fuzz::exampleFronts());
  try {
    known.setName(request.id, request.name, "room");
  } catch (const core::NameError& error) {
    known.setName(request.id, error.proposal(), "room");
  }
  core::toUrdf({known.at(3), known.at(4)}, "map", "cabinet");
}

void answer(const EvaluateModel::Request& request) { evaluateModel(request, {}); }
void answer(const ProjectPoses::Request& request) { projectPoses(request); }
void answer(const ProjectConfigurations::Request& request) { projectConfigurations(request); }

/// Requests about a model that is sent in, of a free curve, which has the most to say.
std::vector<std::string> requestsWithModels() {
  const core::KnownFront front = test::learned(test::garageModel(), 5);
  EvaluateModel::Request evaluate;
  evaluate.model = toMessage(front.model, "map");
  evaluate.track = toMessage(front.track, "map");
  ProjectPoses::Request poses;
  poses.model = evaluate.model;
  poses.poses = evaluate.track.poses;
  ProjectConfigurations::Request configurations;
  configurations.model = toMessage(test::doorModel(), "map");
  configurations.q = {-0.25, 0.5, 1.25};
  using fuzz::serialized;
  return {kEvaluate + serialized(evaluate), kProjectPoses + serialized(poses),
          kProjectConfigurations + serialized(configurations)};
}

}  // namespace

fuzz::Seeds fuzz::seeds() {
  Predict::Request predict;
  predict.id = 3;
  predict.q = {-0.25, 0.5, 1.25};
  Configuration::Request configuration;
  configuration.id = 6;
  configuration.pose = toMessage(test::facingCamera(0.1, 0.2, 1.3));
  HandlePath::Request path;
  path.id = 4;
  path.grasp_point.x = 0.125;
  path.grasp_orientation.w = 1;
  path.q_from = 0.0625;
  path.q_to = 0.25;
  path.steps = 5;
  ExportUrdf::Request urdf;
  urdf.ids = {3, 4};
  SetName::Request name;
  name.id = 4;
  name.name = "front_3";
  Predict::Request many = predict;
  many.q.assign(1000000, 0.5);
  ExportUrdf::Request all;
  all.ids.assign(1000000, 3);
  std::vector<std::string> small = requestsWithModels();
  small.insert(small.end(), {kPredict + serialized(predict), kConfiguration + serialized(configuration),
                             kHandlePath + serialized(path), kExportUrdf + serialized(urdf), kSetName + serialized(name)});
  return {small, {kPredict + serialized(many), kExportUrdf + serialized(all)}};
}

/// What the services on learned models do with a request; the first byte says which service.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  return fuzz::examineMessages<core::ModelError>(data + 1, size - 1, [service = data[0]](fuzz::MessageReader& reader) {
    if (service == kPredict) answer(*reader.next<Predict::Request>());
    if (service == kConfiguration) answer(*reader.next<Configuration::Request>());
    if (service == kHandlePath) answer(*reader.next<HandlePath::Request>());
    if (service == kSetName) answer(*reader.next<SetName::Request>());
    if (service == kEvaluate) answer(*reader.next<EvaluateModel::Request>());
    if (service == kProjectPoses) answer(*reader.next<ProjectPoses::Request>());
    if (service == kProjectConfigurations) answer(*reader.next<ProjectConfigurations::Request>());
    if (service == kExportUrdf) answer(*reader.next<ExportUrdf::Request>());
  });
}
