// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/tracker/abandoned_tracks.h"

#include <algorithm>

#include "tracking/matching/same_front.h"

namespace cabinet_articulation::core {

void AbandonedTracks::add(const Track& track) {
  entries_.push_back({track.id, track.revision, track.observations.back().rectangle});
  if (entries_.size() > static_cast<std::size_t>(config_.max_ended_tracks)) entries_.pop_front();
}

std::optional<AbandonedTracks::Entry> AbandonedTracks::take(const Rectangle& rectangle) {
  auto best = entries_.end();
  double most = 0;
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
    const double overlap = overlapInOnePlace(entry->rectangle, rectangle, config_);
    if (overlap > most) best = entry;
    most = std::max(most, overlap);
  }
  if (best == entries_.end()) return std::nullopt;
  const Entry taken = *best;
  entries_.erase(best);
  return taken;
}

bool AbandonedTracks::forget(std::uint32_t id) {
  const auto entry = std::find_if(entries_.begin(), entries_.end(), [id](const Entry& known) { return known.id == id; });
  if (entry == entries_.end()) return false;
  entries_.erase(entry);
  return true;
}

bool AbandonedTracks::contains(std::uint32_t id) const {
  return std::any_of(entries_.begin(), entries_.end(), [id](const Entry& entry) { return entry.id == id; });
}

}  // namespace cabinet_articulation::core
