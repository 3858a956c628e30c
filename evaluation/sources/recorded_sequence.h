// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "sources/frame_source.h"

namespace cabinet_articulation::core::evaluation {

/// A folder with left_####.png, right_####.png, calibration.json (CameraInfo fields of both cameras) and truth.json (poses
/// of all fronts in the left optical frame; see README.md). Without a left_0000.png, depth_####.png takes the place of the pair.
/// Without calibration.json, its content is `calibration` in truth.json. Throws std::runtime_error that names the file.
std::unique_ptr<FrameSource> openRecordedSequence(const std::string& folder);

}  // namespace cabinet_articulation::core::evaluation
