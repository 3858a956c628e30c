// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace cabinet_articulation::core {

/// From the median of absolute deviations to the standard deviation: 1 / the 75 % quantile of the standard Gaussian (0.6745).
constexpr double kDeviationToSigma = 1.4826;

/// The upper of two in the middle; 0 of none.
double median(std::vector<double> values);

}  // namespace cabinet_articulation::core
