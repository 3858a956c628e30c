// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/models/model_services.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/prediction.h"
#include "cabinet_articulation/joints/urdf.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "nodelets/models/offer_service.h"
#include "nodelets/models/stateless_services.h"
#include "ros/answers/joints.h"
#include "ros/messages/kind_messages.h"

namespace cabinet_articulation {
namespace {

Eigen::Isometry3d graspOf(const HandlePath::Request& request) {
  geometry_msgs::Pose grasp;
  grasp.position = request.grasp_point;
  grasp.orientation = request.grasp_orientation;
  const geometry_msgs::Quaternion& q = grasp.orientation;
  if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0) grasp.orientation.w = 1;
  return fromMessage(grasp);
}

double configurationOf(const core::LearnedModel& model, double requested, bool as_opening) {
  return as_opening ? core::configurationAtOpening(model, requested) : requested;
}

}  // namespace

template <class Service>
void ModelServices::advertise(const std::string& name,
                              void (ModelServices::*answer)(const typename Service::Request&, typename Service::Response*)) {
  const auto ask = [this, answer](const auto& request, auto* response) { (this->*answer)(request, response); };
  servers_.push_back(offerService<Service>(&nh_, name, guard_, ask));
}

ModelServices::ModelServices(ros::NodeHandle nh, const core::ArticulationConfig& config, const std::string& models_file,
                             ModelStore* store, const CallbackGuard& guard)
    : nh_(std::move(nh)), models_file_(models_file), store_(*store), guard_(guard), config_(config) {
  advertise<Predict>("predict", &ModelServices::predict);
  advertise<Configuration>("configuration", &ModelServices::configuration);
  advertise<FitTrack>("fit_track", &ModelServices::fitTrack);
  advertise<Forget>("forget", &ModelServices::forget);
  advertise<HandlePath>("handle_path", &ModelServices::handlePath);
  advertise<SaveModels>("save_models", &ModelServices::saveModels);
  advertise<LoadModels>("load_models", &ModelServices::loadModels);
  advertise<ExportUrdf>("export_urdf", &ModelServices::exportUrdf);
  advertise<Kinds>("kinds", &ModelServices::kinds);
  advertise<SetName>("set_name", &ModelServices::setName);
  advertise<std_srvs::Trigger>("reset", &ModelServices::reset);
  const auto settings = [this] { return settingsNow(); };
  for (const ros::ServiceServer& server : offerStatelessServices(&nh_, settings, guard_)) servers_.push_back(server);
}

void ModelServices::shutdown() {
  for (ros::ServiceServer& server : servers_) server.shutdown();
}

void ModelServices::setConfig(const core::ArticulationConfig& config) {
  std::lock_guard<std::mutex> lock(mutex_);
  config_ = config;
}

core::ArticulationConfig ModelServices::settingsNow() {
  std::lock_guard<std::mutex> lock(mutex_);
  return config_;
}

core::LearnedModel ModelServices::modelOf(std::uint32_t id, std_msgs::Header* header) const {
  const core::LearnedModel model = store_.modelOf(id, &header->frame_id);
  core::requireJoint(model);
  header->stamp = toStamp(model.stamp);
  return model.parent == 0 ? model : core::placed(model, store_.jointModels());
}

void ModelServices::predict(const Predict::Request& request, Predict::Response* response) {
  const core::LearnedModel model = modelOf(request.id, &response->header);
  if (request.q.empty()) throw core::ModelError("q is empty, expected the openings to predict");
  core::requireAtMost("openings in q", request.q.size(), core::limits::kMostEntries);
  std::vector<double> openings = request.q;
  for (double& q : openings) q = configurationOf(model, q, request.as_opening);
  for (const double q : openings) response->poses.push_back(toMessage(core::predictWithCovariance(model, q)));
  const auto [lowest, highest] = std::minmax_element(openings.begin(), openings.end());
  response->message = core::outsideSeenRange(model, *lowest, *highest);
}

void ModelServices::configuration(const Configuration::Request& request, Configuration::Response* response) {
  std_msgs::Header header;
  const core::LearnedModel model = modelOf(request.id, &header);
  const core::NearestConfiguration nearest = core::findConfiguration(model, fromMessage(request.pose));
  response->q = nearest.q;
  response->opening = core::openingAt(model, nearest.q);
  response->residual = nearest.position_residual;
  response->orientation_residual = nearest.orientation_residual;
  response->message = core::outsideSeenRange(model, nearest.q, nearest.q);
}

void ModelServices::fitTrack(const FitTrack::Request& request, FitTrack::Response* response) {
  const core::Track track = wholeTrack(request.track);
  if (track.observations.empty()) throw core::ModelError("the track has no poses");
  for (const core::LearnedModel& model : core::fitAllModels(track, settingsNow()))
    response->models.push_back(toMessage(model, request.track.header.frame_id));
  if (response->models.empty()) throw core::ModelError("no pose of the track can be used");
}

void ModelServices::handlePath(const HandlePath::Request& request, HandlePath::Response* response) {
  const core::LearnedModel model = modelOf(request.id, &response->header);
  const int steps = static_cast<int>(std::min<std::uint32_t>(request.steps, std::numeric_limits<int>::max()));
  const double q_from = configurationOf(model, request.q_from, request.as_opening);
  const double q_to = configurationOf(model, request.q_to, request.as_opening);
  const auto path = core::handlePath(model, graspOf(request), q_from, q_to, steps);
  for (int i = 0; i < steps; ++i) {
    response->q.push_back(q_from + (q_to - q_from) * i / (steps - 1));
    response->poses.push_back(toMessage(path[static_cast<std::size_t>(i)]));
  }
  response->message = core::outsideSeenRange(model, std::min(q_from, q_to), std::max(q_from, q_to));
}

void ModelServices::saveModels(const SaveModels::Request& request, SaveModels::Response* response) {
  response->message = store_.save(fileOr(request.file));
}

void ModelServices::loadModels(const LoadModels::Request& request, LoadModels::Response* response) {
  response->message = store_.load(fileOr(request.file));
}

void ModelServices::exportUrdf(const ExportUrdf::Request& request, ExportUrdf::Response* response) {
  std::vector<core::LearnedModel> models;
  std::string frame_id;
  core::requireAtMost("ids", request.ids.size(), core::limits::kMostEntries);
  for (const std::uint32_t id : std::set<std::uint32_t>(request.ids.begin(), request.ids.end()))
    models.push_back(store_.modelOf(id, &frame_id));
  models = core::withParents(std::move(models), store_.jointModels());
  if (request.ids.empty())
    for (const core::LearnedModel& model : store_.jointModels(&frame_id))
      if (core::hasUrdf(model)) models.push_back(model);
  if (request.ids.empty()) models = core::thoseOnKnown(models);
  if (from_closed_ && !request.ids.empty()) std::for_each(models.begin(), models.end(), core::requireClosed);
  if (from_closed_) models = core::allCountedFromClosed(models);
  if (models.empty())
    throw core::ModelError(std::string("no prismatic or rotational joint is known yet; fronts must be seen while they move") +
                           (from_closed_ ? ", and closed, since joint_zero is 'closed'" : ""));
  response->urdf = core::toUrdf(models, frame_id, jointPrefix(nh_.getNamespace()));
}

void ModelServices::reset(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response* response) {
  store_.reset();
  response->message = "everything is forgotten";
}

void ModelServices::kinds(const Kinds::Request& request, Kinds::Response* response) {
  if (request.clear) store_.clearKinds();
  std::lock_guard<std::mutex> learning(store_.learning());
  response->kinds = toMessages(store_.kinds().kinds());
  response->message = std::to_string(response->kinds.size()) + " kinds are known";
  if (request.clear) response->message = "all kinds are forgotten; fronts that are known teach theirs again when they are seen";
}

void ModelServices::forget(const Forget::Request& request, Forget::Response* response) {
  response->message = store_.forget(request.id);
}

void ModelServices::setName(const SetName::Request& request, SetName::Response* response) {
  response->message = store_.setName(request.id, request.name);
}

std::string ModelServices::fileOr(const std::string& requested) const {
  if (requested.empty() && models_file_.empty()) throw core::ModelFileError("no file is given, and models_file is not set");
  return requested.empty() ? models_file_ : requested;
}

}  // namespace cabinet_articulation
