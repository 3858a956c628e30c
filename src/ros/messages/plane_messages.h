// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/PlaneArray.h>
#include <std_msgs/Header.h>

#include <memory>
#include <vector>

#include "bend/bend_basis.h"
#include "cabinet_articulation/planes/plane_region.h"

namespace cabinet_articulation {

/// Makes messages whose masks' memory comes back when the last subscriber lets go of them, in whatever thread: the masks of
/// one frame are some 6 MB. The messages may outlive this object.
class PlaneMessages {
 public:
  PlaneMessages();

  PlaneArrayPtr make(const std::vector<core::PlaneRegion>& regions, const std_msgs::Header& header);

 private:
  struct SpareMasks;
  std::shared_ptr<SpareMasks> spare_;
};

/// The bend that was taken from the disparity before planes were looked for; an empty list says 0.
std::vector<double> toMessage(const core::BendVector& bend);

/// Throws std::invalid_argument that names the element, its value and what was expected.
core::BendVector bendOf(const PlaneArray& message);

}  // namespace cabinet_articulation
