// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "pipeline/bend_file.h"

namespace cabinet_articulation::core {

/// Gives each camera the bend that an earlier run learned, and keeps what this run learns, in a bend file.
class KeptBends {
 public:
  /// Throws as readBendFile; then nothing is saved later.
  void read(const std::string& file);

  /// Cameras that are known.
  std::size_t size() const { return bends_.size(); }

  /// To be called before each frame of a depth camera. Another camera than before begins with what is known of it.
  void follow(const std::string& camera, SensorBend* bend);

  /// Keeps the bend of the last camera, and saves those that were learned. Returns how many; 0 without a file. Throws as
  /// saveBends.
  std::size_t save(const SensorBend& bend);

 private:
  void keep(const SensorBend& bend);

  std::string file_;                ///< empty: nothing is to be saved
  std::string camera_;              ///< frame that the bend is of
  BendsOfCameras bends_, learned_;  ///< all, and those of this run
};

}  // namespace cabinet_articulation::core
