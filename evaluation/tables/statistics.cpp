// SPDX-License-Identifier: BSD-3-Clause
#include "tables/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace cabinet_articulation::core::evaluation {
namespace {
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
}

double mean(const std::vector<double>& values) {
  return values.empty() ? kNothing : std::accumulate(values.begin(), values.end(), 0.0) / values.size();
}

double standardDeviation(const std::vector<double>& values) {
  const double center = mean(values);
  double sum = 0;
  for (const double value : values) sum += (value - center) * (value - center);
  return values.empty() ? kNothing : std::sqrt(sum / values.size());
}

double quantile(std::vector<double> values, double p) {
  if (values.empty()) return kNothing;
  std::sort(values.begin(), values.end());
  const double place = p * (values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - below) * (values[above] - values[below]);
}

}  // namespace cabinet_articulation::core::evaluation
