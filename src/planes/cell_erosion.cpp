// SPDX-License-Identifier: BSD-3-Clause
#include "planes/cell_erosion.h"

#include <algorithm>

namespace cabinet_articulation::core {
namespace {

/// Three rows of cells.
struct Rows {
  const std::uint8_t *up, *middle, *down;

  std::uint8_t column(int col) const { return up[col] & middle[col] & down[col]; }
};

__attribute__((target_clones("avx2", "default"))) void erodeRow(Rows rows, int n, std::uint8_t* __restrict eroded) {
  for (int col = 1; col < n - 1; ++col) eroded[col] = rows.column(col - 1) & rows.column(col) & rows.column(col + 1);
  for (const int col : {0, n - 1}) {
    const int left = std::max(col - 1, 0), right = std::min(col + 1, n - 1);
    eroded[col] = rows.column(left) & rows.column(col) & rows.column(right);
  }
}

}  // namespace

void erode(const cv::Mat1b& cells, const cv::Range& rows, cv::Mat1b* eroded) {
  eroded->create(cells.size());
  for (int row = rows.start; row < rows.end; ++row)
    erodeRow({cells[std::max(row - 1, 0)], cells[row], cells[std::min(row + 1, cells.rows - 1)]}, cells.cols, (*eroded)[row]);
}

}  // namespace cabinet_articulation::core
