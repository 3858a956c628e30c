// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/watched_subscriber.h"

#include <sstream>

namespace cabinet_articulation {

std::string WatchedSubscriber::silence(double patience) const {
  const double silent = ros::WallTime::now().toSec() - heard_;
  if (!subscriber() || silent <= patience) return "";
  std::ostringstream text;
  text.precision(0);
  text << std::fixed << topic_ << ": nothing received for " << silent << " s, ";
  if (publishers() == 0)
    text << "nobody publishes it";
  else
    text << "although " << publishers() << (publishers() == 1 ? " publisher offers it" : " publishers offer it");
  return text.str();
}

}  // namespace cabinet_articulation
