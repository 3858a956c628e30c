// SPDX-License-Identifier: BSD-3-Clause
#include "model_services.h"

#include <cabinet_articulation/KnownFrontArray.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <utility>

#include "cabinet_articulation/joints/prediction.h"
#include "cabinet_articulation/joints/urdf.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/joints.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

geometry_msgs::PoseWithCovariance withCovariance(const core::UncertainPose& pose) {
  geometry_msgs::PoseWithCovariance message;
  message.pose = toMessage(pose.pose);
  message.covariance = toMessage(pose.covariance);
  return message;
}

Eigen::Isometry3d graspOf(const HandlePath::Request& request) {
  geometry_msgs::Pose grasp;
  grasp.position = request.grasp_point;
  grasp.orientation = request.grasp_orientation;
  const geometry_msgs::Quaternion& q = grasp.orientation;
  if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0) grasp.orientation.w = 1;
  return fromMessage(grasp);
}

}  // namespace

template <class Service>
void ModelServices::advertise(const std::string& name,
                              void (ModelServices::*answer)(const typename Service::Request&, typename Service::Response*)) {
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  const boost::function<bool(Request&, Response&)> callback = [this, answer](Request& request, Response& response) {
    try {
      (this->*answer)(request, &response);
      response.success = true;
    } catch (const std::exception& error) {
      response = Response();
      response.success = false;
      response.message = error.what();
    }
    return true;
  };
  servers_.push_back(nh_.advertiseService<Request, Response>(name, callback));
}

ModelServices::ModelServices(ros::NodeHandle nh, const core::ArticulationConfig& config, const ModelFileConfig& file,
                             std::function<void()> on_reset)
    : nh_(std::move(nh)), file_(file), on_reset_(std::move(on_reset)), config_(config) {
  if (file_.save_at_exit && file_.models_file.empty())
    throw core::ConfigError("save_at_exit is true, and models_file does not say where to save");
  constexpr bool kLatched = true;
  known_fronts_ = nh_.advertise<KnownFrontArray>("known_fronts", 1, kLatched);
  advertise<Predict>("predict", &ModelServices::predict);
  advertise<Configuration>("configuration", &ModelServices::configuration);
  advertise<FitTrack>("fit_track", &ModelServices::fitTrack);
  advertise<HandlePath>("handle_path", &ModelServices::handlePath);
  advertise<SaveModels>("save_models", &ModelServices::saveModels);
  advertise<LoadModels>("load_models", &ModelServices::loadModels);
  advertise<ExportUrdf>("export_urdf", &ModelServices::exportUrdf);
  advertise<std_srvs::Trigger>("reset", &ModelServices::reset);
}

std::string ModelServices::loadAtStart() {
  if (file_.models_file.empty()) return "";
  if (!std::ifstream(file_.models_file)) return "model file '" + file_.models_file + "' is not there yet";
  return load(file_.models_file);
}

std::string ModelServices::finish() {
  for (ros::ServiceServer& server : servers_) server.shutdown();
  if (!file_.save_at_exit) return "";
  if (known_.joints().empty()) return "nothing was learned that could be saved";
  return save(file_.models_file);
}

bool ModelServices::isOutdated(const TrackArray& tracks) const {
  std::lock_guard<std::mutex> lock(mutex_);
  const bool tracker_listens = known_fronts_.getNumSubscribers() > 0;
  return tracker_listens && generation_ != 0 && tracks.generation != generation_;
}

std::string ModelServices::followFrame(const std::string& frame_id) {
  std::lock_guard<std::mutex> lock(mutex_);
  const std::string before = frame_id_;
  frame_id_ = frame_id;
  if (before.empty() || before == frame_id) return "";
  restart({frame_id, {}});
  return "what was known is in the frame '" + before + "' and tracks are in '" + frame_id +
         "', so it is forgotten; see fixed_frame";
}

void ModelServices::update(std::vector<core::Track> tracks, const std::vector<core::LearnedModel>& models) {
  std::lock_guard<std::mutex> lock(mutex_);
  known_.update(std::move(tracks), models);
}

sensor_msgs::JointState ModelServices::lastJointStates(const std::string& prefix) const {
  std::lock_guard<std::mutex> lock(mutex_);
  std::vector<core::LearnedModel> models;
  for (const core::KnownFront& front : known_.joints()) models.push_back(front.model);
  return cabinet_articulation::lastJointStates(models, frame_id_, prefix);
}

void ModelServices::setConfig(const core::ArticulationConfig& config) {
  std::lock_guard<std::mutex> lock(mutex_);
  config_ = config;
}

core::LearnedModel ModelServices::modelOf(std::uint32_t id, std_msgs::Header* header) const {
  std::lock_guard<std::mutex> lock(mutex_);
  const core::LearnedModel& model = known_.at(id);
  core::requireJoint(model);
  header->frame_id = frame_id_;
  header->stamp = toStamp(model.stamp);
  return model;
}

void ModelServices::predict(const Predict::Request& request, Predict::Response* response) {
  const core::LearnedModel model = modelOf(request.id, &response->header);
  if (request.q.empty()) throw core::ModelError("q is empty, expected the openings to predict");
  for (const double q : request.q) response->poses.push_back(withCovariance(core::predictWithCovariance(model, q)));
  const auto [lowest, highest] = std::minmax_element(request.q.begin(), request.q.end());
  response->message = core::outsideSeenRange(model, *lowest, *highest);
}

void ModelServices::configuration(const Configuration::Request& request, Configuration::Response* response) {
  std_msgs::Header header;
  const core::LearnedModel model = modelOf(request.id, &header);
  const core::NearestConfiguration nearest = core::findConfiguration(model, fromMessage(request.pose));
  response->q = nearest.q;
  response->residual = nearest.position_residual;
  response->orientation_residual = nearest.orientation_residual;
  response->message = core::outsideSeenRange(model, nearest.q, nearest.q);
}

void ModelServices::fitTrack(const FitTrack::Request& request, FitTrack::Response* response) {
  const core::Track track = fromMessage(request.track);
  if (track.observations.empty()) throw core::ModelError("the track has no poses");
  core::ArticulationConfig config;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    config = config_;
  }
  for (const core::LearnedModel& model : core::fitAllModels(track, config))
    response->models.push_back(toMessage(model, request.track.header.frame_id));
  if (response->models.empty()) throw core::ModelError("no pose of the track can be used");
}

void ModelServices::handlePath(const HandlePath::Request& request, HandlePath::Response* response) {
  const core::LearnedModel model = modelOf(request.id, &response->header);
  const int steps = static_cast<int>(std::min<std::uint32_t>(request.steps, std::numeric_limits<int>::max()));
  const auto path = core::handlePath(model, graspOf(request), request.q_from, request.q_to, steps);
  for (int i = 0; i < steps; ++i) {
    response->q.push_back(request.q_from + (request.q_to - request.q_from) * i / (steps - 1));
    response->poses.push_back(withCovariance(path[static_cast<std::size_t>(i)]));
  }
  response->message =
      core::outsideSeenRange(model, std::min(request.q_from, request.q_to), std::max(request.q_from, request.q_to));
}

void ModelServices::saveModels(const SaveModels::Request& request, SaveModels::Response* response) {
  response->message = save(fileOr(request.file));
}

void ModelServices::loadModels(const LoadModels::Request& request, LoadModels::Response* response) {
  response->message = load(fileOr(request.file));
}

void ModelServices::exportUrdf(const ExportUrdf::Request& request, ExportUrdf::Response* response) {
  std::vector<core::LearnedModel> models;
  std::lock_guard<std::mutex> lock(mutex_);
  for (const std::uint32_t id : request.ids) models.push_back(known_.at(id));
  if (request.ids.empty())
    for (const core::KnownFront& front : known_.joints())
      if (core::hasUrdf(front.model)) models.push_back(front.model);
  if (models.empty())
    throw core::ModelError("no prismatic or rotational joint is known yet; fronts must be seen while they move");
  response->urdf = core::toUrdf(models, frame_id_, jointPrefix(nh_.getNamespace()));
}

void ModelServices::reset(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response* response) {
  startFrom({});
  response->message = "everything is forgotten";
}

std::string ModelServices::fileOr(const std::string& requested) const {
  if (requested.empty() && file_.models_file.empty()) throw core::ModelFileError("no file is given, and models_file is not set");
  return requested.empty() ? file_.models_file : requested;
}

std::string ModelServices::save(const std::string& path) {
  core::ModelFile models;
  {
    std::lock_guard<std::mutex> lock(mutex_);
    models = {frame_id_, known_.joints()};
  }
  core::writeModelFile(path, models);
  file_was_good_ = true;
  return std::to_string(models.fronts.size()) + " fronts saved to '" + path + "'";
}

std::string ModelServices::load(const std::string& path) {
  const core::ModelFile models = core::readModelFile(path);
  {
    std::lock_guard<std::mutex> lock(mutex_);
    if (!frame_id_.empty() && models.frame != frame_id_ && !models.fronts.empty())
      throw core::ModelFileError("model file '" + path + "': its poses are in the frame '" + models.frame + "', tracks in '" +
                                 frame_id_ + "'; nothing is loaded");
  }
  const std::string text = std::to_string(models.fronts.size()) + " fronts loaded from '" + path + "'";
  startFrom(models);
  file_was_good_ = true;
  return text;
}

void ModelServices::startFrom(const core::ModelFile& models) {
  std::lock_guard<std::mutex> learning(learning_);
  std::lock_guard<std::mutex> lock(mutex_);
  restart(models);
}

void ModelServices::startAfresh() {
  std::lock_guard<std::mutex> lock(mutex_);
  restart({frame_id_, known_.joints()});
}

void ModelServices::restart(const core::ModelFile& models) {
  on_reset_();
  known_.replace(models.fronts);
  if (!models.fronts.empty()) frame_id_ = models.frame;
  KnownFrontArray message;
  message.header.frame_id = frame_id_;
  // A number that no run before had, so that a nodelet that was started again is not mistaken for its predecessor.
  generation_ = std::max(generation_ + 1, ros::WallTime::now().sec);
  message.generation = generation_;
  for (const core::KnownFront& front : models.fronts) message.tracks.push_back(toMessage(front.track, models.frame));
  known_fronts_.publish(message);
}

}  // namespace cabinet_articulation
