// SPDX-License-Identifier: BSD-3-Clause
#include "closing/view_memory.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "geometry/message_precision.h"

namespace cabinet_articulation::core {

void ViewMemory::add(DepthView view) {
  if (view.empty() || (!views_.empty() && view.stamp == views_.back().stamp)) return;
  if (!views_.empty() && view.stamp < views_.back().stamp) views_.clear();
  views_.push_back(std::move(view));
  if (views_.size() <= kMostViews) return;
  // The gap that a view leaves, by its age. The first and the two newest stay.
  const double now = views_.back().stamp;
  std::size_t least = 1;
  double least_loss = 0;
  for (std::size_t i = 1; i + 2 < views_.size(); ++i) {
    const double loss = (views_[i + 1].stamp - views_[i - 1].stamp) / (now - views_[i].stamp);
    if (i > 1 && loss >= least_loss) continue;
    least = i;
    least_loss = loss;
  }
  views_.erase(views_.begin() + static_cast<std::ptrdiff_t>(least));
}

bool ViewMemory::has(double stamp) const {
  return std::any_of(views_.begin(), views_.end(), [stamp](const DepthView& view) { return isSameStamp(view.stamp, stamp); });
}

}  // namespace cabinet_articulation::core
