// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/models/model_store.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "cabinet_articulation/ros/conversions.h"
#include "ros/answers/joints.h"

namespace cabinet_articulation {
namespace {

std::uint32_t idAfter(std::uint32_t id) { return id == std::numeric_limits<std::uint32_t>::max() ? id : id + 1; }

}  // namespace

ModelStore::ModelStore(ros::NodeHandle nh, const ModelFileConfig& file, const core::LearningConfig& config, StoreCalls calls,
                       const CallbackGuard& guard)
    : nh_(std::move(nh)), file_(file), calls_(std::move(calls)), kinds_(config) {
  if (file_.save_at_exit && file_.models_file.empty())
    throw core::ConfigError("save_at_exit is true, and models_file does not say where to save");
  known_fronts_ = nh_.advertise<KnownFrontArray>(
      "known_fronts", 1, [this, guard](const auto& subscriber) { guard("known_fronts", [&] { greet(subscriber); }); });
}

/// A tracker that is started later, or again, hears of what is known by then, and which ids are used up.
void ModelStore::greet(const ros::SingleSubscriberPublisher& subscriber) const {
  std::lock_guard<std::mutex> lock(mutex_);
  if (generation_ != 0 || next_id_ != 0) subscriber.publish(listOf({frame_id_, known_.joints()}));
}

std::string ModelStore::loadAtStart() {
  if (file_.models_file.empty()) return "";
  std::error_code error;
  if (!std::filesystem::exists(file_.models_file, error) && !error)
    return "model file '" + file_.models_file + "' is not there yet";
  return load(file_.models_file);
}

std::string ModelStore::load(const std::string& file) {
  std::lock_guard<std::mutex> filing(filing_);
  const core::ModelFile models = core::readModelFile(file);
  const std::string taken = nameOfFrame(models.frame);
  for (const core::KnownFront& front : models.fronts)
    if (!taken.empty() && front.model.name == taken)
      throw core::ModelFileError("model file '" + file + "': front " + std::to_string(front.model.id) + " is called '" + taken +
                                 "', and its frame would be that of all models; give it another name there");
  {
    std::lock_guard<std::mutex> learning(learning_);
    std::lock_guard<std::mutex> lock(mutex_);
    if (!frame_id_.empty() && models.frame != frame_id_ && !models.fronts.empty())
      throw core::ModelFileError("model file '" + file + "': its poses are in the frame '" + models.frame + "', tracks in '" +
                                 frame_id_ + "'; nothing is loaded");
    removed_.loaded(models.fronts);
    restart(models);
    kinds_.startFrom(models.kinds, modelsOf(models.fronts));
    cleared_kinds_.replaced(file);
  }
  calls_.file_was_good();
  const std::string changes = core::inWords(models.changes);
  return std::to_string(models.fronts.size()) + " fronts loaded from '" + file + "'" +
         (changes.empty() ? "" : "; " + changes + ", for 0 is nobody's id");
}

/// The name whose frame would be `frame_id`; empty if there is none.
std::string ModelStore::nameOfFrame(const std::string& frame_id) const {
  const std::string prefix = jointPrefix(nh_.getNamespace()) + "_";
  return frame_id.rfind(prefix, 0) == 0 ? frame_id.substr(prefix.size()) : "";
}

std::string ModelStore::save(const std::string& file) {
  std::lock_guard<std::mutex> filing(filing_);
  core::ModelFile models;
  std::vector<core::ForgottenFront> removed;
  {
    std::lock_guard<std::mutex> learning(learning_);
    std::lock_guard<std::mutex> lock(mutex_);
    models = {frame_id_, known_.joints()};
    std::set<std::uint32_t> ids;
    for (const core::KnownFront& front : models.fronts) ids.insert(front.model.id);
    models.kinds = kinds_.votesBeside(ids);
    models.replaces_kinds = cleared_kinds_.in(file);
    removed = removed_.in(file);
  }
  const core::SavedModels saved = core::saveModelFile(file, models, removed);
  calls_.file_was_good();
  std::lock_guard<std::mutex> learning(learning_);
  std::lock_guard<std::mutex> lock(mutex_);
  cleared_kinds_.replaced(file);
  removed_.saved(file, models.fronts);
  return saved.inWords(file);
}

std::string ModelStore::saveAtExit() {
  if (!file_.save_at_exit) return "";
  {
    std::lock_guard<std::mutex> learning(learning_);
    std::lock_guard<std::mutex> lock(mutex_);
    const bool no_kinds = kinds_.kinds().empty() && !cleared_kinds_.in(file_.models_file);
    if (known_.jointModels().empty() && removed_.empty() && no_kinds) return "nothing was learned that could be saved";
  }
  return save(file_.models_file);
}

std::string ModelStore::forget(std::uint32_t id) {
  std::lock_guard<std::mutex> filing(filing_);
  core::ForgottenFront forgotten;
  std::vector<core::JointShape> votes;
  std::string frame;
  {
    std::lock_guard<std::mutex> learning(learning_);
    std::lock_guard<std::mutex> lock(mutex_);
    forgotten = known_.forget(id);
    frame = frame_id_;
    calls_.forget(id);
    votes = kinds_.votesOf(id);
    kinds_.forget(id);
    removed_.add(forgotten);
    forgotten_.insert(id);
    known_fronts_.publish(listOf({frame_id_, known_.joints()}));
  }
  const std::string text = "front " + std::to_string(id) + " is forgotten" + core::childrenInWords(forgotten);
  if (file_.models_file.empty()) return text;
  try {
    const std::size_t gone = core::removeFromModelFile(file_.models_file, frame, {forgotten}, votes);
    return text + (gone > 0 ? " and taken from '" : "; it was not in '") + file_.models_file + "'";
  } catch (const core::ModelFileError& error) {
    return text + ", but may still be in the file: " + error.what();
  }
}

void ModelStore::reset() {
  std::lock_guard<std::mutex> filing(filing_);
  std::lock_guard<std::mutex> learning(learning_);
  std::lock_guard<std::mutex> lock(mutex_);
  for (const core::LearnedModel& model : known_.jointModels()) removed_.add(model);
  restart({frame_id_, {}});
  forgetKinds();
}

void ModelStore::clearKinds() {
  std::lock_guard<std::mutex> filing(filing_);
  std::lock_guard<std::mutex> learning(learning_);
  std::lock_guard<std::mutex> lock(mutex_);
  forgetKinds();
}

void ModelStore::forgetKinds() {
  kinds_.reset();
  cleared_kinds_.clear();
}

std::string ModelStore::setName(std::uint32_t id, const std::string& name) {
  std::lock_guard<std::mutex> lock(mutex_);
  known_.setName(id, name, nameOfFrame(frame_id_));
  const std::string text = "front " + std::to_string(id) + " is called '" + name + "' now";
  const std::vector<core::LearnedModel> kept = known_.jointModels();
  const bool is_kept = std::any_of(kept.begin(), kept.end(), [id](const auto& model) { return model.id == id; });
  return text + (is_kept ? "" : "; it is no joint yet, and only joints are saved and remembered");
}

GenerationWatch::Verdict ModelStore::judge(const TrackArray& tracks) {
  std::lock_guard<std::mutex> lock(mutex_);
  const GenerationWatch::Verdict verdict =
      watch_.judge(tracks.generation, known_fronts_.getNumSubscribers() > 0, ros::SteadyTime::now().toSec());
  if (verdict.send_again) known_fronts_.publish(listOf({frame_id_, known_.joints()}));
  return verdict;
}

std::string ModelStore::followFrame(const std::string& frame_id) {
  std::lock_guard<std::mutex> lock(mutex_);
  const std::string before = frame_id_;
  frame_id_ = frame_id;
  if (before.empty() || before == frame_id) return "";
  removed_.clear();
  restart({frame_id, {}});
  return "what was known is in the frame '" + before + "' and tracks are in '" + frame_id +
         "', so it is forgotten; see fixed_frame";
}

void ModelStore::dropForgotten(std::vector<core::TrackUpdate>* tracks) const {
  std::lock_guard<std::mutex> lock(mutex_);
  const auto is_forgotten = [this](const core::TrackUpdate& update) { return forgotten_.count(update.track.id) > 0; };
  tracks->erase(std::remove_if(tracks->begin(), tracks->end(), is_forgotten), tracks->end());
}

std::size_t ModelStore::follow(std::vector<core::TrackUpdate> updates) {
  std::lock_guard<std::mutex> lock(mutex_);
  for (const core::TrackUpdate& update : updates) next_id_ = std::max(next_id_, idAfter(update.track.id));
  return known_.follow(std::move(updates));
}

void ModelStore::update(std::vector<core::LearnedModel>* models) {
  std::lock_guard<std::mutex> lock(mutex_);
  known_.update(*models);
  known_.giveNames(models);
  kinds_.complete(known_.tracks(), models);
}

core::LearnedModel ModelStore::modelOf(std::uint32_t id, std::string* frame_id) const {
  std::lock_guard<std::mutex> lock(mutex_);
  *frame_id = frame_id_;
  return kinds_.told(known_.at(id));
}

std::vector<core::LearnedModel> ModelStore::jointModels(std::string* frame_id) const {
  std::lock_guard<std::mutex> lock(mutex_);
  if (frame_id != nullptr) *frame_id = frame_id_;
  std::vector<core::LearnedModel> models = known_.jointModels();
  for (core::LearnedModel& model : models) model = kinds_.told(model);
  return models;
}

void ModelStore::startAfresh() {
  std::lock_guard<std::mutex> lock(mutex_);
  restart({frame_id_, known_.joints()});
}

void ModelStore::restart(const core::ModelFile& models) {
  for (const core::KnownFront& front : models.fronts) {
    next_id_ = std::max(next_id_, idAfter(front.model.id));
    forgotten_.erase(front.model.id);
  }
  calls_.start_from(modelsOf(models.fronts));
  kinds_.keepFronts(modelsOf(models.fronts));
  known_.replace(models.fronts);
  if (!models.fronts.empty()) frame_id_ = models.frame;
  // A number that no run before had, so that a nodelet that was started again is not mistaken for its predecessor.
  generation_ = std::max(generation_ + 1, ros::WallTime::now().sec);
  watch_.expect(generation_);
  known_fronts_.publish(listOf({frame_id_, models.fronts}));
}

KnownFrontArray ModelStore::listOf(const core::ModelFile& models) const {
  KnownFrontArray message;
  message.header.frame_id = models.frame;
  message.generation = generation_;
  message.next_id = next_id_;
  message.forgotten.assign(forgotten_.begin(), forgotten_.end());
  for (const core::KnownFront& front : models.fronts) message.tracks.push_back(toMessage(front.track, models.frame));
  return message;
}

}  // namespace cabinet_articulation
