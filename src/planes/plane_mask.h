// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "planes/disparity_tolerance.h"

namespace cabinet_articulation::core {

/// Eq. (2) for every pixel, with a tolerance that follows the noise. In-plane pixels whose residual exceeds `limit` [px] are
/// `kOtherPlane` (ours): without that label a door grows over the neighbour that its plane cuts. Uses the memory of `mask`
/// again if it has the size of the disparity.
void labelByNoise(const cv::Mat1f& disparity, const DisparityPlane& plane, const DisparityTolerance& tolerance,
                  const cv::Mat1f& limit, cv::Mat1b* mask);

/// Eq. (2) as the paper has it: in-plane is within `distance` [m] of the plane, measured along its normal (Eq. 1).
void labelByDistance(const DepthFrame& frame, const Plane& plane, double distance, cv::Mat1b* mask);

}  // namespace cabinet_articulation::core
