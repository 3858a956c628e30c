// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/rectangle_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "tracking/continuation.h"
#include "tracking/ended_tracks.h"
#include "tracking/history.h"
#include "tracking/placement.h"
#include "tracking/same_front.h"
#include "tracking/track_memory.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kProposedSigma = 0.03;      ///< [m] of a size good enough to be searched for: seen in two or three frames
constexpr int kJudgedFrames = 8;             ///< a presence over fewer frames says little
constexpr int kEstablished = 20;             ///< frames; what was seen that often is no flicker
constexpr int kLongestFlicker = 3;           ///< frames; a longer absence is one absence, not so many misses
constexpr double kResizeStep = 0.002;        ///< [m] smaller changes of the size are not worth placing the history anew
constexpr double kRotationTolerance = 1e-3;  ///< entries of R R^T - I of a pose that is meant to be a rotation

bool isUsable(const DetectedRectangle& detection) {
  const Rectangle& rectangle = detection.rectangle;
  const Eigen::Matrix3d& R = rectangle.pose.linear();
  return rectangle.pose.matrix().allFinite() && detection.covariance.allFinite() && std::isfinite(rectangle.width) &&
         std::isfinite(rectangle.height) && rectangle.width > 0 && rectangle.height > 0 &&
         (R * R.transpose()).isIdentity(kRotationTolerance) && R.determinant() > 0;
}

/// All observations with the track's new size, from the newest back: the size was known worst at the beginning. The newest
/// continues from `reference`.
void placeAnew(Track& track, const KnownSize& size, const KnownPlace& reference, const TrackingConfig& config) {
  KnownPlace later = reference;
  for (auto observation = track.observations.rbegin(); observation != track.observations.rend(); ++observation) {
    DetectedRectangle detection;
    detection.rectangle = observation->measured;
    detection.covariance = observation->measured_covariance;
    detection.edge_support = observation->edge_support;
    const DetectedRectangle placed = placeOnObservedEdges(detection, size, &later, config);
    observation->rectangle = placed.rectangle;
    observation->covariance = placed.covariance;
    later = {placed.rectangle, placed.covariance.topLeftCorner<3, 3>()};
  }
}

}  // namespace

RectangleTracker::RectangleTracker(const TrackingConfig& config)
    : config_(config),
      live_(std::make_unique<RememberedTracks>()),
      ended_(std::make_unique<EndedTracks>(config)),
      last_stamp_(-std::numeric_limits<double>::infinity()) {
  checkConfig(config);
}

RectangleTracker::~RectangleTracker() = default;

const std::vector<Track>& RectangleTracker::tracks() const { return live_->tracks; }

void RectangleTracker::reset() {
  live_->clear();
  ended_->clear();
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
  const bool was_live = live_->erase(id);
  return ended_->forget(id) || was_live;
}

void RectangleTracker::useIdsFrom(std::uint32_t id) { next_id_ = std::max(next_id_, id); }

bool RectangleTracker::isKnown(std::uint32_t id) const { return live_->contains(id) || ended_->contains(id); }

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
      append(stamp, usable[i], live_->tracks[track_of[i]], live_->memories[track_of[i]]);
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
  }
  *live_ = std::move(live);
}

void RectangleTracker::append(double stamp, const DetectedRectangle& rectangle, Track& track, TrackMemory& memory) const {
  const Continuation found = *findContinuation(track, memory, rectangle, stamp, config_);
  const DetectedRectangle& measured = found.measured;
  memory.frames += std::min(memory.unseen, kLongestFlicker);
  memory.unseen = 0;
  memory.last_seen = stamp;
  ++memory.seen;
  track.hollow = track.hollow || rectangle.hollow;
  memory.size.add(measured);
  const KnownSize& known = memory.size.known();
  const bool resized = (known.value - Eigen::Vector2d(track.width, track.height)).cwiseAbs().maxCoeff() > kResizeStep ||
                       (known.sigma.array() < memory.placed_sigma.array() / 2).any();
  if (resized) {
    track.width = known.value.x();
    track.height = known.value.y();
    memory.placed_sigma = known.sigma;
  }
  const DetectedRectangle placed = placeOnObservedEdges(measured, known, &found.reference, config_);
  track.observations.push_back(
      {stamp, placed.rectangle, placed.covariance, measured.edge_support, measured.rectangle, measured.covariance});
  if (resized) placeAnew(track, known, found.reference, config_);
  if (resized) ++track.revision;
  thinOut(track.observations, config_.max_observations);
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
      append(stamp, (*unclaimed)[i], track, memory);
      live_->insert(std::move(track), std::move(memory));
    } else {
      unknown.push_back((*unclaimed)[i]);
    }
  }
  *unclaimed = std::move(unknown);
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
    Track track;
    track.id = takeId();
    track.width = detection.rectangle.width;
    track.height = detection.rectangle.height;
    track.hollow = detection.hollow;
    track.observations.push_back(
        {stamp, detection.rectangle, detection.covariance, detection.edge_support, detection.rectangle, detection.covariance});
    TrackMemory memory{FrontSize(config_)};
    memory.size.add(detection);
    memory.last_seen = stamp;
    live_->insert(std::move(track), std::move(memory));
  }
}

}  // namespace cabinet_articulation::core
