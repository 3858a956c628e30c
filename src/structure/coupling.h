// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

namespace cabinet_articulation::core {

/// Configurations of two fronts at the same times.
struct ConfigurationPairs {
  std::vector<double> first, second;
  double first_metres = 1, second_metres = 1;  ///< [m per unit of q] how far q moves what moves most of its front
};

/// By how much the second q grows with the first, if one is a linear function of the other: the two have one degree of freedom
/// together. Nothing if both go their own ways, or did not move at once. The log-likelihood of a line with noise of
/// sigma_position is compared with that of a free second q, Eq. (6). Only pairs count that are a noise's width apart. (The
/// original release counts the principal components of all configurations instead.)
std::optional<double> ratioOfCoupled(const ConfigurationPairs& pairs, double sigma_position);

}  // namespace cabinet_articulation::core
