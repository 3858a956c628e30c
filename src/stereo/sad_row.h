// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cabinet_articulation::core {

constexpr int kSadBatch = 16;   ///< pixels that are matched together; up to 15 beyond the last are computed and dropped
constexpr int kSadStride = 64;  ///< entries that are read together: buffers have multiples of them

/// One row of block matching by sums of absolute differences (SAD). The entries of a pixel lie side by side in memory, the
/// largest disparity first, as the right image's columns do. So entry k of column u meets column u - largest_disparity + k.
struct SadRow {
  const std::uint8_t *left_enters, *right_enters;  ///< column 0 of the filtered row that enters the windows
  const std::uint8_t *left_leaves, *right_leaves;  ///< and of the one that leaves them
  int first, end;                                  ///< [px] columns that are matched: first <= u < end
  int radius;                                      ///< [px] of the window: it has 2 radius + 1 columns
  int disparities;                                 ///< [px] entries of a pixel, a multiple of 16
  int largest_disparity;                           ///< [px]
  int stride;                                      ///< disparities, rounded up to kSadStride

  /// Updated by the row: sums of each column of the windows, from column first - radius; before it lie 2 radius + 1 columns of 0.
  std::int16_t* column_sums;
  std::int16_t* window_sums;  ///< scratch: kSadBatch windows
  const int* texture;         ///< sum of the windows' absolute gradients, by their central column
  int texture_threshold;
  int uniqueness_ratio;      ///< [%]
  std::int16_t unmatched;    ///< the result where there is no match
  std::int16_t* sixteenths;  ///< [px/16] column 0 of the result; null: only column_sums are updated
};

using SadRowFunction = void (*)(const SadRow&);

/// With the vectors that every processor of this architecture has.
void matchSadRow(const SadRow& row);

/// With AVX2, or null if this build has none. All sums are whole numbers: the results are the same.
SadRowFunction sadRowForAvx2();

}  // namespace cabinet_articulation::core
