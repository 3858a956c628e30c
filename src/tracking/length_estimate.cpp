// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/length_estimate.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {
constexpr double kBin = 1e-4;          ///< [m]
constexpr double kLongest = 10;        ///< [m] bounds the number of bins
constexpr double kLeastWeight = 1e-6;  ///< small enough that a million unseen edges do not outweigh a seen one
}  // namespace

void LengthEstimate::add(double length, double weight) {
  histogram_[static_cast<int>(std::min(length, kLongest) / kBin)] += std::max(weight, kLeastWeight);
  weight_ += weight;
}

double LengthEstimate::quantile(double share) const {
  double total = 0;
  for (const auto& bin : histogram_) total += bin.second;
  double below = 0;
  for (const auto& [index, weight] : histogram_) {
    if (below + weight >= share * total) return (index + (share * total - below) / weight) * kBin;
    below += weight;
  }
  return histogram_.empty() ? 0 : (histogram_.rbegin()->first + 1) * kBin;
}

}  // namespace cabinet_articulation::core
