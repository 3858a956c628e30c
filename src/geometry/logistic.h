// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace cabinet_articulation::core {

/// The probability that has these log odds [nats].
inline double logistic(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

}  // namespace cabinet_articulation::core
