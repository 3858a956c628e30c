// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace cabinet_articulation::core::evaluation {

/// All three are NaN without values.
double mean(const std::vector<double>& values);
double standardDeviation(const std::vector<double>& values);

/// The value below which the share `p` (0..1) of the values lies, interpolated between neighbours.
double quantile(std::vector<double> values, double p);

inline double median(const std::vector<double>& values) { return quantile(values, 0.5); }

}  // namespace cabinet_articulation::core::evaluation
