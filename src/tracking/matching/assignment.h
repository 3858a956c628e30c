// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace cabinet_articulation::core {

/// The assignment of rows to columns with the least total cost: for every row its column, or -1. Exact (successive
/// shortest augmenting paths). A row left alone costs `alone`, and pairs that cost more than that (infinity: forbidden)
/// are never made. Ties are broken the same way every time.
std::vector<int> assignRows(const Eigen::MatrixXd& cost, double alone);

}  // namespace cabinet_articulation::core
