// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/PlaneArray.h>
#include <std_msgs/Header.h>

#include <memory>
#include <vector>

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

}  // namespace cabinet_articulation
