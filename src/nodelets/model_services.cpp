// SPDX-License-Identifier: BSD-3-Clause
#include "model_services.h"

#include <cabinet_articulation/KnownFrontArray.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "cabinet_articulation/joints/prediction.h"
#include "cabinet_articulation/ros/conversions.h"
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

ModelServices::ModelServices(ros::NodeHandle nh, const core::ArticulationConfig& config, std::function<void()> on_reset)
    : nh_(std::move(nh)), config_(config), on_reset_(std::move(on_reset)) {
  constexpr bool kLatched = true;
  known_fronts_ = nh_.advertise<KnownFrontArray>("known_fronts", 1, kLatched);
  advertise<Predict>("predict", &ModelServices::predict);
  advertise<Configuration>("configuration", &ModelServices::configuration);
  advertise<FitTrack>("fit_track", &ModelServices::fitTrack);
  advertise<HandlePath>("handle_path", &ModelServices::handlePath);
  advertise<std_srvs::Trigger>("reset", &ModelServices::reset);
}

void ModelServices::shutdown() {
  for (ros::ServiceServer& server : servers_) server.shutdown();
}

bool ModelServices::isOutdated(const TrackArray& tracks) const {
  std::lock_guard<std::mutex> lock(mutex_);
  const bool tracker_listens = known_fronts_.getNumSubscribers() > 0;
  return tracker_listens && generation_ != 0 && tracks.generation != generation_;
}

void ModelServices::update(const std_msgs::Header& header, std::vector<core::Track> tracks,
                           const std::vector<core::LearnedModel>& models) {
  std::lock_guard<std::mutex> lock(mutex_);
  frame_id_ = header.frame_id;
  known_.update(std::move(tracks), models);
}

void ModelServices::clear() {
  std::lock_guard<std::mutex> lock(mutex_);
  known_.replace({});
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
  for (const core::LearnedModel& model : core::fitAllModels(track, config_))
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

void ModelServices::reset(const std_srvs::Trigger::Request&, std_srvs::Trigger::Response* response) {
  std::lock_guard<std::mutex> lock(learning_);
  on_reset_();
  startGeneration();
  response->message = "everything is forgotten";
}

void ModelServices::startGeneration() {
  std::lock_guard<std::mutex> lock(mutex_);
  known_.replace({});
  KnownFrontArray message;
  message.header.frame_id = frame_id_;
  // A number that no run before had, so that a nodelet that was started again is not mistaken for its predecessor.
  generation_ = std::max(generation_ + 1, ros::WallTime::now().sec);
  message.generation = generation_;
  known_fronts_.publish(message);
}

}  // namespace cabinet_articulation
