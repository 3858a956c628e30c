// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "cabinet_articulation/stereo/depth_view.h"

namespace cabinet_articulation::core {

/// What was seen, in bounded memory: the newest views all, older ones the more sparsely the older they are. So a front that is
/// opened after hours is still seen at rest.
class ViewMemory {
 public:
  static constexpr std::size_t kMostViews = 64;  ///< ours: 1.2 MB

  /// A view that is not newer than the last one starts anew: time was set back.
  void add(DepthView view);

  /// Oldest first.
  const std::vector<DepthView>& views() const { return views_; }

  /// Whether the view of this stamp is still there.
  bool has(double stamp) const;

 private:
  std::vector<DepthView> views_;
};

}  // namespace cabinet_articulation::core
