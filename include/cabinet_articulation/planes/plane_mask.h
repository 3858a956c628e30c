// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>

#include "cabinet_articulation/planes/disparity_tolerance.h"
#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// Eq. (2) for every pixel, in fresh memory, with a tolerance that follows the noise. In-plane pixels whose residual exceeds
/// `limit` [px] are `kOtherPlane` (ours): without that label a door grows over the neighbour that its plane cuts.
cv::Mat1b labelByNoise(const cv::Mat1f& disparity, const DisparityPlane& plane, const DisparityTolerance& tolerance,
                       const cv::Mat1f& limit);

/// Eq. (2) as the paper has it: in-plane is within `distance` [m] of the plane, measured along its normal (Eq. 1).
cv::Mat1b labelByDistance(const DepthFrame& frame, const Plane& plane, double distance);

}  // namespace cabinet_articulation::core
