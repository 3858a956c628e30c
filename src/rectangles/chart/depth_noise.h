// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace cabinet_articulation::core {

constexpr double kLeastSigma = 0.02;  ///< [px] of disparities that were rounded (ours)
constexpr double kOutlier = 3;        ///< standard deviations beyond which a pixel shows something else

}  // namespace cabinet_articulation::core
