// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/original_learner.h"

#include <ros/serialization.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "bridge/original_model.h"
#include "cabinet_articulation/articulation/articulation_learner.h"
#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::ModelMsg;

/// Describes, evaluates and samples a model on the track that the message has.
void fill(const core::LearnedModel& model, const OriginalTrack& track, const core::ArticulationConfig& config,
          ModelMsg* message) {
  describe(model, track.T_pose_center, message);
  evaluate(model, track, config, message);
  resample(model, track.T_pose_center, message);
}

/// Only this type is fitted. A free curve is asked only where no joint explains a track, so it has a rigid one beside it.
core::ArticulationConfig only(core::JointType type, core::ArticulationConfig config) {
  config.joint_types = originalName(type);
  if (type == core::JointType::kNonparametric) config.joint_types += " " + originalName(core::JointType::kRigid);
  return config;
}

core::LearnedModel fitted(core::JointType type, const core::Track& track, const core::ArticulationConfig& config) {
  for (const core::LearnedModel& model : core::fitAllModels(track, only(type, config)))
    if (model.type == type) return model;
  throw std::runtime_error("no " + originalName(type) + " model can be fitted to these " +
                           std::to_string(track.observations.size()) + " poses");
}

void append(const articulation_msgs::TrackMsg& from, articulation_msgs::TrackMsg* to) {
  const std::size_t before = to->pose.size();
  to->pose.insert(to->pose.end(), from.pose.begin(), from.pose.end());
  to->pose_headers.clear();  // the stamps of two recordings say nothing of their order
  std::vector<sensor_msgs::ChannelFloat32> both;
  for (sensor_msgs::ChannelFloat32 entry : to->channels) {
    const auto same = [&](const auto& other) { return other.name == entry.name; };
    const auto found = std::find_if(from.channels.begin(), from.channels.end(), same);
    if (found == from.channels.end() || entry.values.size() != before) continue;
    entry.values.insert(entry.values.end(), found->values.begin(), found->values.end());
    both.push_back(entry);
  }
  to->channels = both;
}

/// BIC without what is paid for free configurations, as the original release sums it over models.
double withoutFreedom(const ModelMsg& model) {
  return requireParam(model.params, "bic") - 2 * requireParam(model.params, "cost_of_freedom");
}

/// A stored model that takes another track in.
struct Rival {
  ModelMsg model;   ///< refitted to both tracks
  double more = 0;  ///< by which the sum of BIC grows
};

/// Both BICs are by the same settings: those at the time of storing may have been others. Nothing where it cannot be refitted.
std::optional<Rival> merged(ModelMsg stored, const articulation_msgs::TrackMsg& track, const core::ArticulationConfig& config) {
  try {
    const OriginalTrack own = fromOriginal(stored.track);
    evaluate(restore(stored, own), own, config, &stored);
    const double before = withoutFreedom(stored);
    append(track, &stored.track);
    stored.track.id = track.id;
    const OriginalTrack both = fromOriginal(stored.track);
    fill(fitted(typeOf(stored.name), both.track, config), both, config, &stored);
    return Rival{stored, withoutFreedom(stored) - before};
  } catch (const std::exception&) {
    return std::nullopt;  // such a model is no rival
  }
}

/// The poses of all that select() would refit.
std::size_t posesToRefit(const std::map<int, ModelMsg>& stored, std::size_t more) {
  std::size_t poses = 0;
  for (const auto& [id, model] : stored) poses += model.track.pose.size() + more;
  return poses;
}

std::size_t sizeOf(const ModelMsg& model) { return ros::serialization::serializationLength(model); }

int firstFreeId(const std::map<int, ModelMsg>& stored) {
  int id = 0;
  while (stored.count(id) > 0) ++id;
  return id;
}

}  // namespace

core::ArticulationConfig configured(core::ArticulationConfig config, const Params& params) {
  core::requireAtMost("params", params.size(), core::limits::kMostEntries);
  config.sigma_position = paramOr(params, "sigma_position", config.sigma_position);
  config.sigma_orientation = paramOr(params, "sigma_orientation", config.sigma_orientation);
  if (paramOr(params, "disable_all", 0) != 0) {
    config.joint_types.clear();
    for (const std::string& name : originalNames())
      if (paramOr(params, "enable_" + name, 0) != 0) config.joint_types += name + " ";
  }
  core::checkConfig(config);
  return config;
}

void requireSoon(const std::string& what, std::size_t poses) {
  if (poses > kMostFittedPoses)
    throw std::invalid_argument(what + " would take fits to " + std::to_string(poses) + " poses, expected at most " +
                                std::to_string(kMostFittedPoses) + ": the bridge answers nothing else meanwhile");
}

void fitTo(const core::ArticulationConfig& config, ModelMsg* message) {
  const OriginalTrack track = fromOriginal(message->track);
  const std::vector<core::LearnedModel> models = core::fitAllModels(track.track, config);
  if (models.empty()) throw std::runtime_error("no pose of the track can be used");
  fill(models.front(), track, config, message);
}

ModelMsg OriginalLearner::select(const Model& request) const {
  const core::ArticulationConfig config = configured(config_, request.params);
  ModelMsg best = request;
  best.id = -1;
  requireSoon("asking " + std::to_string(stored_.size()) + " stored models", posesToRefit(stored_, request.track.pose.size()));
  fitTo(config, &best);
  double least = withoutFreedom(best);
  for (const auto& [id, stored] : stored_) {
    const std::optional<Rival> rival = merged(stored, request.track, config);
    if (!rival || rival->more >= least) continue;
    least = rival->more;
    best = rival->model;
  }
  return best;
}

ModelMsg OriginalLearner::fit(const Model& request) const {
  const core::ArticulationConfig config = configured(config_, request.params);
  const OriginalTrack track = fromOriginal(request.track);
  ModelMsg answer = request;
  fill(fitted(typeOf(request.name), track.track, config), track, config, &answer);
  return answer;
}

ModelMsg OriginalLearner::eval(const Model& request) const {
  const OriginalTrack track = fromOriginal(request.track);
  ModelMsg answer = request;
  evaluate(restore(request, track), track, configured(config_, request.params), &answer);
  return answer;
}

ModelMsg OriginalLearner::posesToConfigurations(const Model& request) const {
  const OriginalTrack track = fromOriginal(request.track);
  const core::LearnedModel model = restore(request, track);
  ModelMsg answer = request;
  std::vector<float>& q = channel("q0", &answer.track);
  for (std::size_t i = 0; i < q.size(); ++i)
    q[i] = static_cast<float>(model.configuration(track.track.observations[i].rectangle.pose));
  return answer;
}

ModelMsg OriginalLearner::configurationsToPoses(const Model& request) const {
  const OriginalTrack track = fromOriginal(request.track);
  const core::LearnedModel model = restore(request, track);
  ModelMsg answer = request;
  const auto is_q = [](const auto& entry) { return entry.name == "q0"; };
  if (std::none_of(answer.track.channels.begin(), answer.track.channels.end(), is_q))
    throw std::invalid_argument("the track has no channel 'q0'");
  answer.track.pose_projected.clear();
  for (const float q : channel("q0", &answer.track)) {
    core::requireWithin("q0", q, core::limits::kConfiguration);
    answer.track.pose_projected.push_back(toMessage(model.predict(q) * track.T_pose_center.inverse()));
  }
  return answer;
}

ModelMsg OriginalLearner::resampled(const Model& request) const {
  ModelMsg answer = request;
  const OriginalTrack track = fromOriginal(request.track);
  resample(restore(request, track), track.T_pose_center, &answer);
  return answer;
}

ModelMsg OriginalLearner::store(const Model& request) {
  const auto before = stored_.find(request.id);
  const bool is_new = before == stored_.end();
  core::requireAtMost("stored models", stored_.size() + (is_new ? 1 : 0), core::limits::kMostFronts);
  ModelMsg kept = eval(request);
  if (kept.id < 0) kept.id = firstFreeId(stored_);
  const std::size_t bytes = bytes_ - (is_new ? 0 : sizeOf(before->second)) + sizeOf(kept);
  core::requireAtMost("bytes in stored models", bytes, kMostStoredBytes);
  bytes_ = bytes;
  return stored_[kept.id] = kept;
}

std::vector<ModelMsg> OriginalLearner::prior() const {
  std::vector<ModelMsg> models;
  for (const auto& [id, model] : stored_) models.push_back(model);
  return models;
}

void OriginalLearner::setPrior(const std::vector<Model>& models) {
  OriginalLearner fresh(config_);
  for (std::size_t i = 0; i < models.size(); ++i) {
    try {
      if (fresh.stored_.count(models[i].id) > 0)
        throw std::invalid_argument("id " + std::to_string(models[i].id) + " is there twice");
      fresh.store(models[i]);
    } catch (const std::exception& error) {
      throw std::invalid_argument("model[" + std::to_string(i) + "]: " + error.what());
    }
  }
  *this = std::move(fresh);
}

}  // namespace cabinet_articulation::bridge
