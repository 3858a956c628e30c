// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "bend/sensor_bend.h"

namespace cabinet_articulation::core {

using BendsOfCameras = std::map<std::string, KnownBend>;  ///< by the frame of the camera

/// What earlier runs learned; nothing if there is no such file. Throws std::runtime_error that names the file, the field and what
/// was expected.
BendsOfCameras readBendFile(const std::string& path);

/// Adds to the file, or replaces, the bends of these cameras; those of other cameras stay. Throws std::runtime_error, as for a
/// file that is no such file, which stays as it is.
void saveBends(const std::string& path, const BendsOfCameras& bends);

}  // namespace cabinet_articulation::core
