// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/rectangle_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "tracking/matching/same_front.h"
#include "tracking/matching/track_memory.h"
#include "tracking/tracker/abandoned_tracks.h"
#include "tracking/tracker/ended_tracks.h"
#include "tracking/tracker/track_growth.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kProposedSigma = 0.03;      ///< [m] of a size good enough to be searched for: seen in two or three frames
constexpr int kJudgedFrames = 8;             ///< a presence over fewer frames says little
constexpr int kEstablished = 20;             ///< frames; what was seen that often is no flicker
constexpr double kRotationTolerance = 1e-3;  ///< entries of R R^T - I of a pose that is meant to be a rotation

bool isUsable(const DetectedRectangle& detection) {
  const Rectangle& rectangle = detection.rectangle;
  const Eigen::Matrix3d& R = rectangle.pose.linear();
  return rectangle.pose.matrix().allFinite() && detection.covariance.allFinite() && std::isfinite(rectangle.width) &&
         std::isfinite(rectangle.height) && rectangle.width > 0 && rectangle.height > 0 &&
         (R * R.transpose()).isIdentity(kRotationTolerance) && R.determinant() > 0;
}

}  // namespace

RectangleTracker::RectangleTracker(const TrackingConfig& config)
    : config_(config),
      live_(std::make_unique<RememberedTracks>()),
      ended_(std::make_unique<EndedTracks>(config)),
      abandoned_(std::make_unique<AbandonedTracks>(config)),
      last_stamp_(-std::numeric_limits<double>::infinity()) {
  checkConfig(config);
}

RectangleTracker::~RectangleTracker() = default;

const std::vector<Track>& RectangleTracker::tracks() const { return live_->tracks; }

void RectangleTracker::reset() {
  live_->clear();
  ended_->clear();
  abandoned_->clear();
  last_stamp_ = -std::numeric_limits<double>::infinity();
}

void RectangleTracker::remember(std::vector<Track> fronts) {
  for (Track& front : fronts) {
    if (front.observations.empty() || front.id == 0 || front.id > kLargestId || isKnown(front.id)) continue;
    useIdsFrom(front.id + 1);
    TrackMemory memory = memoryOf(front, config_);
    ended_->keep(std::move(front), std::move(memory));
  }
}

std::vector<Track> RectangleTracker::knownTracks() const {
  std::vector<Track> tracks = live_->tracks;
  tracks.insert(tracks.end(), ended_->tracks().begin(), ended_->tracks().end());
  return tracks;
}

bool RectangleTracker::forget(std::uint32_t id) {
  const bool was_live = live_->erase(id), had_ended = ended_->forget(id);
  return abandoned_->forget(id) || had_ended || was_live;
}

void RectangleTracker::useIdsFrom(std::uint32_t id) { next_id_ = std::max(next_id_, id); }

bool RectangleTracker::isKnown(std::uint32_t id) const {
  return live_->contains(id) || ended_->contains(id) || abandoned_->contains(id);
}

std::uint32_t RectangleTracker::takeId() {
  while (next_id_ == 0 || isKnown(next_id_)) ++next_id_;
  return next_id_++;
}

const std::vector<Track>& RectangleTracker::process(double stamp, const std::vector<DetectedRectangle>& rectangles) {
  if (!std::isfinite(stamp) || !(stamp > last_stamp_)) return live_->tracks;
  last_stamp_ = stamp;
  endTracks(stamp);
  std::vector<DetectedRectangle> usable;
  std::copy_if(rectangles.begin(), rectangles.end(), std::back_inserter(usable), isUsable);
  const std::vector<int> track_of = assignToTracks(usable, *live_, stamp, config_);
  const bool reordered = takeBackYoung(stamp, usable, track_of);
  std::vector<DetectedRectangle> unclaimed;
  for (size_t i = 0; i < usable.size(); ++i) {
    if (track_of[i] < 0)
      unclaimed.push_back(usable[i]);
    else
      append(stamp, usable[i], config_, &live_->tracks[track_of[i]], &live_->memories[track_of[i]]);
  }
  if (reordered) live_->sort();
  takeBack(stamp, &unclaimed);
  startTracks(stamp, std::move(unclaimed));
  return live_->tracks;
}

ExpectedFronts RectangleTracker::expected() const {
  ExpectedFronts expected;
  expected.horizon = config_.prediction_horizon;
  for (size_t i = 0; i < live_->tracks.size(); ++i) {
    const Track& track = live_->tracks[i];
    const KnownSize& size = live_->memories[i].size.known();
    const bool lost = last_stamp_ - track.observations.back().stamp > config_.tentative_timeout;
    if (!isConfirmed(track, config_) || lost || size.sigma.maxCoeff() > kProposedSigma) continue;
    expected.fronts.push_back(newestMotion(track.observations));
    expected.fronts.back().rectangle.width = size.value.x();
    expected.fronts.back().rectangle.height = size.value.y();
  }
  return expected;
}

bool RectangleTracker::flickers(const TrackMemory& memory) const {
  const bool young = memory.frames >= kJudgedFrames && memory.seen < kEstablished;
  // Of so few frames a front may miss more than its share by chance.
  const double share = config_.min_presence, chance = std::sqrt(share * (1 - share) * memory.frames);
  return young && memory.seen < share * memory.frames - chance;
}

void RectangleTracker::endTracks(double stamp) {
  RememberedTracks live;
  for (size_t i = 0; i < live_->tracks.size(); ++i) {
    Track& track = live_->tracks[i];
    TrackMemory& memory = live_->memories[i];
    ++memory.unseen;
    const bool confirmed = isConfirmed(track, config_);
    const double timeout = confirmed ? config_.timeout : std::min(config_.timeout, config_.tentative_timeout);
    const bool lost = stamp - track.observations.back().stamp > timeout;
    if (!lost && !flickers(memory))
      live.insert(std::move(track), std::move(memory));
    else if (confirmed && !flickers(memory))
      ended_->keep(std::move(track), std::move(memory));
    else
      abandoned_->add(track);
  }
  *live_ = std::move(live);
}

bool RectangleTracker::isSeenAlready(double stamp, const Rectangle& rectangle) const {
  return std::any_of(live_->tracks.begin(), live_->tracks.end(), [&](const Track& track) {
    const TrackedObservation& newest = track.observations.back();
    return newest.stamp == stamp && isDuplicate(newest.rectangle, rectangle);
  });
}

bool RectangleTracker::takeBackYoung(double stamp, const std::vector<DetectedRectangle>& rectangles,
                                     const std::vector<int>& track_of) {
  std::vector<DetectedRectangle> young;
  std::vector<int> young_track;
  for (size_t i = 0; i < rectangles.size(); ++i) {
    if (track_of[i] < 0 || isConfirmed(live_->tracks[track_of[i]], config_)) continue;
    young.push_back(rectangles[i]);
    young_track.push_back(track_of[i]);
  }
  bool any = false;
  auto taken = ended_->takeBack(young, stamp);
  for (size_t i = 0; i < taken.size(); ++i) {
    if (!taken[i]) continue;
    std::tie(live_->tracks[young_track[i]], live_->memories[young_track[i]]) = std::move(*taken[i]);
    any = true;
  }
  return any;
}

void RectangleTracker::takeBack(double stamp, std::vector<DetectedRectangle>* unclaimed) {
  const auto seen = [&](const DetectedRectangle& detection) { return isSeenAlready(stamp, detection.rectangle); };
  unclaimed->erase(std::remove_if(unclaimed->begin(), unclaimed->end(), seen), unclaimed->end());
  std::vector<DetectedRectangle> unknown;
  auto taken = ended_->takeBack(*unclaimed, stamp);
  for (size_t i = 0; i < taken.size(); ++i) {
    if (taken[i]) {
      auto& [track, memory] = *taken[i];
      append(stamp, (*unclaimed)[i], config_, &track, &memory);
      live_->insert(std::move(track), std::move(memory));
    } else {
      unknown.push_back((*unclaimed)[i]);
    }
  }
  *unclaimed = std::move(unknown);
}

void RectangleTracker::abandonOvertaken(const Rectangle& rectangle) {
  for (size_t i = live_->tracks.size(); i-- > 0;) {
    const Track& track = live_->tracks[i];
    const TrackMemory& memory = live_->memories[i];
    if (isConfirmed(track, config_) || memory.unseen <= memory.seen) continue;
    if (overlapInOnePlace(track.observations.back().rectangle, rectangle, config_) == 0) continue;
    abandoned_->add(track);
    live_->erase(track.id);
  }
}

void RectangleTracker::startTracks(double stamp, std::vector<DetectedRectangle> unclaimed) {
  const auto support = [](const DetectedRectangle& detection) {
    return std::accumulate(detection.edge_support.begin(), detection.edge_support.end(), 0.F);
  };
  std::stable_sort(unclaimed.begin(), unclaimed.end(),
                   [&](const DetectedRectangle& a, const DetectedRectangle& b) { return support(a) > support(b); });
  for (const DetectedRectangle& detection : unclaimed) {
    if (isSeenAlready(stamp, detection.rectangle)) continue;
    if (std::any_of(live_->tracks.begin(), live_->tracks.end(),
                    [&](const Track& track) { return isPartOf(track, detection.rectangle, stamp, config_); }))
      continue;
    abandonOvertaken(detection.rectangle);
    const std::optional<AbandonedTracks::Entry> before = abandoned_->take(detection.rectangle);
    Track track = startOfTrack(stamp, detection);
    track.id = before ? before->id : takeId();
    track.revision = before ? before->revision + 1 : 0;
    TrackMemory memory = memoryOf(track, config_);
    memory.last_seen = stamp;
    live_->insert(std::move(track), std::move(memory));
  }
}

}  // namespace cabinet_articulation::core
