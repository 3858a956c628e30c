// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/median.h"

#include <algorithm>

namespace cabinet_articulation::core {

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace cabinet_articulation::core
