// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/kept_bends.h"

namespace cabinet_articulation::core {

void KeptBends::read(const std::string& file) {
  bends_ = readBendFile(file);
  file_ = file;
}

void KeptBends::follow(const std::string& camera, SensorBend* bend) {
  if (camera == camera_) return;
  keep(*bend);
  camera_ = camera;
  *bend = SensorBend();
  const auto earlier = bends_.find(camera);
  if (earlier != bends_.end()) bend->startFrom(earlier->second);
}

/// A bend that as many views as before do not confirm is kept as 0.
void KeptBends::keep(const SensorBend& bend) {
  const auto earlier = bends_.find(camera_);
  const bool is_gone = earlier != bends_.end() && bend.views() >= earlier->second.views;
  if (bend.isOwn() && (bend.isKnown() || is_gone)) bends_[camera_] = learned_[camera_] = bend.known();
}

std::size_t KeptBends::save(const SensorBend& bend) {
  keep(bend);
  if (file_.empty() || learned_.empty()) return 0;
  saveBends(file_, learned_);
  return learned_.size();
}

}  // namespace cabinet_articulation::core
