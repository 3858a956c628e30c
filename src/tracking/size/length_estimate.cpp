// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/size/length_estimate.h"

#include <algorithm>
#include <cmath>

namespace cabinet_articulation::core {
namespace {
constexpr double kBin = 1e-4;          ///< [m]
constexpr double kLongest = 10;        ///< [m] bounds the number of bins
constexpr double kLeastWeight = 1e-6;  ///< small enough that a million unseen edges do not outweigh a seen one
}  // namespace

void LengthEstimate::add(double length, double weight) {
  weight = std::max(weight, kLeastWeight);
  histogram_[static_cast<int>(std::min(length, kLongest) / kBin)] += weight;
  best_weight_ = std::max(best_weight_, weight);
  weight_ += weight;
  squares_ += weight * weight;
  const double step = length - mean_;
  mean_ += step * weight / weight_;
  deviation_ += weight * step * (length - mean_);
}

double LengthEstimate::spread() const { return weight_ > 0 ? std::sqrt(std::max(deviation_, 0.0) / weight_) : 0; }

double LengthEstimate::median() const {
  double half = 0;
  for (const auto& bin : histogram_) half += bin.second / 2;
  for (const auto& [index, weight] : histogram_) {
    if (weight >= half) return (index + half / weight) * kBin;
    half -= weight;
  }
  return 0;
}

}  // namespace cabinet_articulation::core
