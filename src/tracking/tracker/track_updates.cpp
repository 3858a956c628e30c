// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/track_updates.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace cabinet_articulation::core {
namespace {

bool isContinued(const Track& known, const TrackUpdate& update) {
  const std::vector<TrackedObservation>& fresh = update.track.observations;
  return known.revision == update.track.revision && update.first < known.observations.size() && !fresh.empty() &&
         known.observations[update.first].stamp == fresh.front().stamp;
}

}  // namespace

bool TrackUpdates::continues(const Sent& sent, const Track& track) {
  return sent.revision == track.revision && sent.count <= track.observations.size() &&
         track.observations[sent.count - 1].stamp == sent.newest;
}

/// The track that has gone out in parts for longest, if that is long; else nobody.
std::uint32_t TrackUpdates::mostOverdue(double stamp) const {
  std::uint32_t id = 0;
  double longest = kWholePeriod;
  for (const auto& [candidate, sent] : sent_) {
    const double since = std::abs(stamp - sent.last_whole);
    if (since < longest) continue;
    longest = since;
    id = candidate;
  }
  return id;
}

std::vector<TrackUpdate> TrackUpdates::of(const std::vector<Track>& tracks, double stamp) {
  const std::uint32_t due = mostOverdue(stamp);
  std::vector<TrackUpdate> updates;
  updates.reserve(tracks.size());
  std::map<std::uint32_t, Sent> now;
  for (const Track& track : tracks) {
    if (track.observations.empty()) continue;
    const auto known = sent_.find(track.id);
    const bool whole = known == sent_.end() || track.id == due || !continues(known->second, track);
    TrackUpdate update;
    // With the last one that is known, by whose stamp receivers recognise that this continues what they have.
    if (!whole) update.first = known->second.count - 1;
    update.track.id = track.id;
    update.track.width = track.width;
    update.track.height = track.height;
    update.track.hollow = track.hollow;
    update.track.revision = track.revision;
    update.track.observations.assign(track.observations.begin() + update.first, track.observations.end());
    now[track.id] = {track.revision, track.observations.size(), track.observations.back().stamp,
                     update.first == 0 ? stamp : known->second.last_whole};
    updates.push_back(std::move(update));
  }
  sent_ = std::move(now);
  return updates;
}

const std::vector<Track>& TrackAssembly::add(std::vector<TrackUpdate> updates) {
  std::vector<Track> before = std::move(tracks_);
  tracks_.clear();
  waiting_ = 0;
  for (TrackUpdate& update : updates) {
    const auto known =
        std::find_if(before.begin(), before.end(), [&](const Track& track) { return track.id == update.track.id; });
    const bool is_known = known != before.end() && !known->observations.empty();
    if (update.first == 0) {
      if (is_known) before.erase(known);
      tracks_.push_back(std::move(update.track));
      continue;
    }
    const bool continues = is_known && isContinued(*known, update);
    if (!continues) ++waiting_;
    if (!is_known) continue;
    Track track = std::move(*known);
    before.erase(known);
    if (continues) {
      track.width = update.track.width;
      track.height = update.track.height;
      track.hollow = update.track.hollow;
      track.observations.resize(update.first);
      track.observations.insert(track.observations.end(), update.track.observations.begin(), update.track.observations.end());
    }
    tracks_.push_back(std::move(track));
  }
  ended_ = std::move(before);
  return tracks_;
}

}  // namespace cabinet_articulation::core
