// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bend/bend_view.h"

namespace cabinet_articulation::core {

struct BendEstimate {
  BendVector bend = BendVector::Zero();        ///< 0 if it is not known
  BendMatrix covariance = BendMatrix::Zero();  ///< of what was taken, where it is known
};

/// The bend that all views have in common, as far as they agree on it (all ours, of textbook parts):
/// - Each view has a noise of its own, which is estimated: a surface that is no plane says less.
/// - The uncertainty comes from how far views agree (jackknife over views: MacKinnon and White 1985). A fold that moves with the
///   scene is in another place of the image in each view, so it makes this large.
/// - Nothing is taken before chance alone could give as much once in a thousand times (F test).
/// - What is taken is shrunk to its expectation, given that uncertainty (empirical Bayes: Efron and Morris 1975).
/// The same views give the same bits.
BendEstimate estimateBend(const std::vector<BendView>& views);

}  // namespace cabinet_articulation::core
