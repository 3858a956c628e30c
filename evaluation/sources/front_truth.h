// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "sources/frame_source.h"

namespace cabinet_articulation::core::evaluation {

/// The simulator's truth about one front, with the shares of it that are inside the image and visible.
Front makeFront(const FrontTruth& truth, const StereoFrame& image, const StereoCamera& camera);

}  // namespace cabinet_articulation::core::evaluation
