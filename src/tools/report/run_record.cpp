// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/run_record.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "cabinet_articulation/joints/hanging.h"
#include "cabinet_articulation/joints/joint.h"
#include "geometry/message_precision.h"

namespace cabinet_articulation {
namespace {

constexpr std::size_t kMostGaps = 256;  ///< of one front (ours)
constexpr std::size_t kMostMoved = 64;  ///< fronts of one page, that somebody may want to read (ours)

/// Room is made by leaving out the shortest.
void addGap(const Range& gap, std::vector<Range>* gaps) {
  gaps->push_back(gap);
  if (gaps->size() <= kMostGaps) return;
  gaps->erase(std::min_element(gaps->begin(), gaps->end(), [](const Range& a, const Range& b) { return a.span() < b.span(); }));
}

/// The observation that this frame brought, if any.
const core::TrackedObservation* newestOf(const core::Track& track, double stamp) {
  if (track.observations.empty() || !core::isSameStamp(track.observations.back().stamp, stamp)) return nullptr;
  return &track.observations.back();
}

}  // namespace

void RunRecord::advance(double stamp) {
  const double elapsed = stamp - stamp_;
  time_before_ = time_;
  if (frames_ > 0) time_ += elapsed > 0 ? elapsed : period();
  stamp_ = stamp;
  ++frames_;
}

/// Samples of one chart are in one frame, so they begin anew when the parent is another one.
void RunRecord::describe(const core::LearnedModel& model, const std::vector<core::LearnedModel>& all, FrontRecord* front) const {
  if (front->model.parent != model.parent) {
    front->observations = Thinned<FrontSample>(kMostSamples);
    front->hangs_since = model.parent != 0 ? std::optional<double>(time_) : std::nullopt;
  }
  front->model = model;
  front->frame.reset();
  if (!core::hangsOnKnown(model, all)) return;
  front->frame = core::frameOf(model, all);
  front->turn = front->frame->linear();
}

void RunRecord::observe(const core::TrackedObservation& observation, FrontRecord* front) const {
  if (!std::exchange(front->was_seen, true)) front->first_seen = front->last_seen = time_;
  if (front->last_seen < time_before_) addGap({front->last_seen, time_}, &front->unseen);
  front->last_seen = time_;
  if (!front->frame) return;
  core::Rectangle rectangle = observation.rectangle;
  if (front->model.parent != 0) rectangle.pose = front->frame->inverse() * rectangle.pose;
  front->observations.add({time_, rectangle, observation.edge_support});
}

std::vector<std::uint32_t> RunRecord::add(double stamp, const core::PipelineResult& result) {
  advance(stamp);
  times_.add({time_, result.milliseconds});
  std::vector<std::uint32_t> new_joints;
  for (const core::LearnedModel& model : result.models) {
    FrontRecord& front = fronts_[model.id];
    describe(model, result.models, &front);
    front.opinions.add({time_, model.probabilities});
    if (front.first_joint || !core::isJoint(model)) continue;
    front.first_joint = time_;
    new_joints.push_back(model.id);
  }
  for (const core::TrackUpdate& update : result.track_updates) {
    const auto front = fronts_.find(update.track.id);
    const core::TrackedObservation* observation = newestOf(update.track, stamp);
    if (front != fronts_.end() && observation != nullptr) observe(*observation, &front->second);
  }
  forgetOthers(result.models);
  return new_joints;
}

void RunRecord::forgetOthers(const std::vector<core::LearnedModel>& models) {
  std::set<std::uint32_t> in_view;
  for (const core::LearnedModel& model : models) in_view.insert(model.id);
  std::vector<std::pair<std::size_t, std::uint32_t>> moved;  // observations, id
  for (auto front = fronts_.begin(); front != fronts_.end();) {
    const bool gone = in_view.count(front->first) == 0;
    if (gone && front->second.model.moved) moved.emplace_back(front->second.observations.count(), front->first);
    front = gone && !front->second.model.moved ? fronts_.erase(front) : std::next(front);
  }
  for (std::sort(moved.begin(), moved.end()); moved.size() > kMostMoved; moved.erase(moved.begin()), ++left_out_)
    fronts_.erase(moved.front().second);
}

void RunRecord::close() {
  for (auto& [id, front] : fronts_) {
    if (front.last_seen < time_) addGap({front.last_seen, time_}, &front.unseen);
    if (front.first_seen > 0) front.unseen.insert(front.unseen.begin(), {0, front.first_seen});
  }
}

std::vector<const FrontRecord*> RunRecord::moved() const {
  std::vector<const FrontRecord*> fronts;
  for (const auto& [id, front] : fronts_)
    if (front.model.moved) fronts.push_back(&front);
  return fronts;
}

}  // namespace cabinet_articulation
