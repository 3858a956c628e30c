// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/rectangle_tracker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "cabinet_articulation/tracking/assignment.h"
#include "cabinet_articulation/tracking/continuation.h"
#include "cabinet_articulation/tracking/history.h"
#include "cabinet_articulation/tracking/placement.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kNone = -1;
constexpr double kUsualDistance = 0.02;      ///< [m] of a detection from its track
constexpr double kNewTrackDistance = 0.2;    ///< [m] a rectangle farther from every track rather is a new front
constexpr double kProposedSigma = 0.03;      ///< [m] of a size good enough to be searched for
constexpr double kTentativeDistance = 0.03;  ///< [m] of two tracks equally near, the confirmed one is right
constexpr int kJudgedFrames = 15;            ///< a presence over fewer frames says little
constexpr double kResizeStep = 0.002;        ///< [m] smaller changes of the size are not worth placing the history anew
constexpr double kRotationTolerance = 1e-3;  ///< entries of R R^T - I of a pose that is meant to be a rotation

bool isUsable(const DetectedRectangle& detection) {
  const Rectangle& rectangle = detection.rectangle;
  const Eigen::Matrix3d& R = rectangle.pose.linear();
  return rectangle.pose.matrix().allFinite() && detection.covariance.allFinite() && std::isfinite(rectangle.width) &&
         std::isfinite(rectangle.height) && rectangle.width > 0 && rectangle.height > 0 &&
         (R * R.transpose()).isIdentity(kRotationTolerance) && R.determinant() > 0;
}

/// Heavy-tailed, so that one good pair and one new track beat two doubtful pairs.
double cost(double distance) { return std::log1p(std::pow(distance / kUsualDistance, 2)); }

/// Two rectangles of one frame that show the same front: they overlap by a good part and lie in one plane.
bool isDuplicate(const Rectangle& a, const Rectangle& b) {
  constexpr double kOverlap = 0.3, kDistance = 0.02, kCosine = 0.995;  // -, m, 6 degrees
  return std::abs(a.normal().dot(b.normal())) > kCosine && std::abs(a.plane().distance(b.center())) < kDistance &&
         intersectionOverUnion(a, b) > kOverlap;
}

/// All observations with the track's new size, from the newest back: the size was known worst at the beginning.
void placeAnew(Track& track, const KnownSize& size, double min_support) {
  const Rectangle* later = nullptr;
  for (auto observation = track.observations.rbegin(); observation != track.observations.rend(); ++observation) {
    DetectedRectangle detection;
    detection.rectangle = observation->measured;
    detection.covariance = observation->measured_covariance;
    detection.edge_support = observation->edge_support;
    const DetectedRectangle placed = placeOnObservedEdges(detection, size, later ? later : &observation->rectangle, min_support);
    observation->rectangle = placed.rectangle;
    observation->covariance = placed.covariance;
    later = &observation->rectangle;
  }
}

}  // namespace

RectangleTracker::RectangleTracker(const TrackingConfig& config)
    : config_(config), last_stamp_(-std::numeric_limits<double>::infinity()) {
  checkConfig(config);
}

void RectangleTracker::reset() {
  tracks_.clear();
  memories_.clear();
  last_stamp_ = -std::numeric_limits<double>::infinity();
}

const std::vector<Track>& RectangleTracker::process(double stamp, const std::vector<DetectedRectangle>& rectangles) {
  if (!std::isfinite(stamp) || !(stamp > last_stamp_)) return tracks_;
  last_stamp_ = stamp;
  endTracks(stamp);
  std::vector<DetectedRectangle> usable;
  std::copy_if(rectangles.begin(), rectangles.end(), std::back_inserter(usable), isUsable);
  const std::vector<int> track_of = assignRectangles(stamp, usable);
  for (size_t i = 0; i < usable.size(); ++i)
    if (track_of[i] != kNone) append(stamp, usable[i], tracks_[track_of[i]], memories_[track_of[i]]);
  startTracks(stamp, usable, track_of);
  return tracks_;
}

std::vector<Rectangle> RectangleTracker::expected(double stamp) const {
  std::vector<Rectangle> places;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    const Track& track = tracks_[i];
    const KnownSize size = memories_[i].size.known(config_);
    const bool lost = last_stamp_ - track.observations.back().stamp > config_.tentative_timeout;
    if (!isConfirmed(track) || lost || size.sigma.maxCoeff() > kProposedSigma) continue;
    places.push_back(extrapolate(track.observations, stamp, config_.prediction_horizon));
    places.back().width = size.value.x();
    places.back().height = size.value.y();
  }
  return places;
}

bool RectangleTracker::flickers(const Memory& memory) const {
  return memory.frames >= kJudgedFrames && memory.seen < config_.min_presence * memory.frames;
}

bool RectangleTracker::isConfirmed(const Track& track) const {
  return track.observations.size() >= static_cast<size_t>(config_.confirmed_after);
}

void RectangleTracker::endTracks(double stamp) {
  size_t kept = 0;
  for (size_t i = 0; i < tracks_.size(); ++i) {
    ++memories_[i].unseen;
    const double unseen = stamp - tracks_[i].observations.back().stamp;
    const double timeout = isConfirmed(tracks_[i]) ? config_.timeout : std::min(config_.timeout, config_.tentative_timeout);
    if (unseen > timeout || flickers(memories_[i])) continue;
    if (kept != i) {
      tracks_[kept] = std::move(tracks_[i]);
      memories_[kept] = std::move(memories_[i]);
    }
    ++kept;
  }
  tracks_.resize(kept);
  memories_.resize(kept);
}

std::vector<int> RectangleTracker::assignRectangles(double stamp, const std::vector<DetectedRectangle>& rectangles) const {
  constexpr double kForbidden = std::numeric_limits<double>::infinity();
  Eigen::MatrixXd costs(rectangles.size(), tracks_.size());
  for (size_t i = 0; i < rectangles.size(); ++i) {
    for (size_t j = 0; j < tracks_.size(); ++j) {
      const auto found = findContinuation(tracks_[j], memories_[j].size, rectangles[i], stamp, config_);
      costs(i, j) = found ? cost(found->distance + (isConfirmed(tracks_[j]) ? 0 : kTentativeDistance)) : kForbidden;
    }
  }
  return assignRows(costs, cost(kNewTrackDistance));
}

void RectangleTracker::append(double stamp, const DetectedRectangle& rectangle, Track& track, Memory& memory) {
  const Continuation found = *findContinuation(track, memory.size, rectangle, stamp, config_);
  const DetectedRectangle& measured = found.measured;
  const bool absent = stamp - track.observations.back().stamp > config_.tentative_timeout;
  memory.frames += absent ? 1 : memory.unseen;
  memory.unseen = 0;
  ++memory.seen;
  memory.size.add(measured);
  const KnownSize known = memory.size.known(config_);
  const bool resized = (known.value - Eigen::Vector2d(track.width, track.height)).cwiseAbs().maxCoeff() > kResizeStep;
  if (resized) {
    track.width = known.value.x();
    track.height = known.value.y();
  }
  const DetectedRectangle placed = placeOnObservedEdges(measured, known, &found.reference, config_.min_edge_support);
  track.observations.push_back(
      {stamp, placed.rectangle, placed.covariance, measured.edge_support, measured.rectangle, measured.covariance});
  if (resized) placeAnew(track, known, config_.min_edge_support);
  const bool thinned = thinOut(track.observations, config_.max_observations);
  if (resized || thinned) ++track.revision;
}

void RectangleTracker::startTracks(double stamp, const std::vector<DetectedRectangle>& rectangles,
                                   const std::vector<int>& track_of) {
  std::vector<size_t> unclaimed;
  for (size_t i = 0; i < rectangles.size(); ++i)
    if (track_of[i] == kNone) unclaimed.push_back(i);
  const auto support = [&](size_t i) {
    return std::accumulate(rectangles[i].edge_support.begin(), rectangles[i].edge_support.end(), 0.F);
  };
  std::stable_sort(unclaimed.begin(), unclaimed.end(), [&](size_t a, size_t b) { return support(a) > support(b); });
  for (const size_t i : unclaimed) {
    const DetectedRectangle& detection = rectangles[i];
    const bool known = std::any_of(tracks_.begin(), tracks_.end(), [&](const Track& track) {
      return track.observations.back().stamp == stamp && isDuplicate(track.observations.back().rectangle, detection.rectangle);
    });
    if (known) continue;
    Track track;
    track.id = next_id_++;
    track.width = detection.rectangle.width;
    track.height = detection.rectangle.height;
    track.observations.push_back(
        {stamp, detection.rectangle, detection.covariance, detection.edge_support, detection.rectangle, detection.covariance});
    tracks_.push_back(std::move(track));
    memories_.emplace_back();
    memories_.back().size.add(detection);
  }
}

}  // namespace cabinet_articulation::core
