// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The same source is compiled for each kind of vectors.

#include <cstdint>

#include "stereo/sad_lanes.h"
#include "stereo/sad_row.h"

namespace cabinet_articulation::core {
namespace {

constexpr int kShortLanes = kByteLanes / 2;

/// A batch of pixels side by side, as plain arrays of fixed size, so that the compiler can vectorise over pixels.
struct SadBatch {
  int threshold[kSadBatch];                                  ///< sums up to it compete with the best
  int first[kSadBatch], last[kSadBatch];                     ///< entries of such sums
  int entry[kSadBatch];                                      ///< the match, or -1
  int before[kSadBatch], best[kSadBatch], after[kSadBatch];  ///< sums around it
};

/// The row that enters is added to the sums of column u, the one that leaves is taken away. Then the window moves on by this
/// column. Returns each lane's smallest sum.
inline ShortLanes advance(const SadRow& row, int u, std::int16_t* column, const std::int16_t* before, std::int16_t* window) {
  const ByteLanes left_enters = allBytes(row.left_enters[u]), left_leaves = allBytes(row.left_leaves[u]);
  const std::uint8_t* right_enters = row.right_enters + u - row.largest_disparity;
  const std::uint8_t* right_leaves = row.right_leaves + u - row.largest_disparity;
  const std::int16_t* passed = column - (2 * row.radius + 1) * row.stride;
  ShortLanes smallest_sums = allShorts(INT16_MAX);
  for (int k = 0; k < row.disparities; k += kByteLanes) {
    ShortLanes low, high;
    wideDifference(distance(left_enters, load(right_enters + k)), distance(left_leaves, load(right_leaves + k)), &low, &high);
    low = plus(low, load(column + k));
    high = plus(high, load(column + k + kShortLanes));
    store(column + k, low);
    store(column + k + kShortLanes, high);
    low = plus(load(before + k), minus(low, load(passed + k)));
    high = plus(load(before + k + kShortLanes), minus(high, load(passed + k + kShortLanes)));
    store(window + k, low);
    store(window + k + kShortLanes, high);
    smallest_sums = smaller(smallest_sums, low);
    if (k + kShortLanes < row.disparities) smallest_sums = smaller(smallest_sums, high);
  }
  return smallest_sums;
}

/// Whether sums are larger than the threshold, one bit for each of 64.
inline std::uint64_t areLarger(const std::int16_t* sums, ShortLanes threshold) {
  std::uint64_t bits = 0;
  for (int k = 0; k < 64; k += kByteLanes, sums += kByteLanes)
    bits |= std::uint64_t{negative(minus(threshold, load(sums)), minus(threshold, load(sums + kShortLanes)))} << k;
  return bits;
}

/// The first and the last sum up to the threshold; there is one.
inline void findCompeting(const SadRow& row, const std::int16_t* sums, int i, SadBatch* batch) {
  const ShortLanes threshold = allShorts(static_cast<std::int16_t>(batch->threshold[i]));
  int first = row.disparities, last = 0;
  for (int k = 0; k < row.disparities; k += 64) {
    std::uint64_t competing = ~areLarger(sums + k, threshold);
    if (row.disparities - k < 64) competing &= (std::uint64_t{1} << (row.disparities - k)) - 1;
    if (competing == 0) continue;
    const int lowest = k + __builtin_ctzll(competing);
    first = lowest < first ? lowest : first;
    last = k + 63 - __builtin_clzll(competing);
  }
  batch->first[i] = first;
  batch->last[i] = last;
}

/// The smallest of the competing sums, the first if there are several. The match is unique if no sum but its neighbours competes.
/// There are no branches: which way they would go is as random as the images.
inline void chooseMatch(const SadRow& row, const std::int16_t* sums, int i, SadBatch* batch) {
  const int span = row.uniqueness_ratio > 0 ? batch->last[i] - batch->first[i] : 0;
  sums += batch->first[i];
  const int second = (span > 0) & (sums[1] < sums[0]);
  const int unique = (span < 2) | ((span == 2) & second & (sums[1] <= sums[2]));
  sums += second;
  batch->entry[i] = (batch->first[i] + second + 1) * unique - 1;
  batch->before[i] = sums[-1];
  batch->best[i] = sums[0];
  batch->after[i] = sums[1];
}

/// The minimum of two lines of opposite slopes through the three sums, as StereoBM places it.
inline std::int16_t interpolate(const SadRow& row, int u, int i, const SadBatch& batch) {
  const int entry = batch.entry[i], before = batch.before[i], after = batch.after[i];
  const int difference = (entry > 0) & (entry < row.disparities - 1) ? after - before : 0;
  const int divisor = after + before - 2 * batch.best[i] + (difference < 0 ? -difference : difference);
  // Both fit into 24 bits, and their quotient into 8: its whole part is that of integer division, for which there are no vectors.
  const float offset = static_cast<float>(difference * 256) / static_cast<float>(divisor > 1 ? divisor : 1);
  const int disparity = ((row.largest_disparity - entry) * 256 + static_cast<int>(offset) + 15) >> 4;
  const bool matched = (entry >= 0) & (row.texture[u] >= row.texture_threshold);
  return static_cast<std::int16_t>(matched ? disparity : row.unmatched);
}

inline void finishBatch(const SadRow& row, int u, SadBatch* batch) {
  for (int i = 0; i < kSadBatch; ++i) {
    const int threshold = batch->threshold[i] + batch->threshold[i] * row.uniqueness_ratio / 100;
    batch->threshold[i] = threshold < INT16_MAX ? threshold : INT16_MAX;
  }
  for (int i = 0; i < kSadBatch; ++i) findCompeting(row, row.window_sums + i * row.stride, i, batch);
  for (int i = 0; i < kSadBatch; ++i) chooseMatch(row, row.window_sums + i * row.stride, i, batch);
  std::int16_t results[kSadBatch];
  for (int i = 0; i < kSadBatch; ++i) results[i] = interpolate(row, u + i, i, *batch);
  for (int i = 0; i < kSadBatch && u + i < row.end; ++i) row.sixteenths[u + i] = results[i];
}

/// The row is a copy: the compiler knows that no store changes it.
inline void matchRow(const SadRow row) {
  std::int16_t* const last_window = row.window_sums + (kSadBatch - 1) * row.stride;
  for (int k = 0; k < row.stride; ++k) last_window[k] = 0;
  std::int16_t* column = row.column_sums + (2 * row.radius + 1) * row.stride;
  for (int u = row.first - row.radius; u < row.first + row.radius; ++u, column += row.stride)
    advance(row, u, column, last_window, last_window);
  SadBatch batch;
  for (int u = row.first; u < row.end; u += kSadBatch) {
    const std::int16_t* before = last_window;
    for (int i = 0; i < kSadBatch; ++i, column += row.stride) {
      std::int16_t* window = row.window_sums + i * row.stride;
      batch.threshold[i] = smallest(advance(row, u + i + row.radius, column, before, window));
      before = window;
    }
    if (row.sixteenths) finishBatch(row, u, &batch);
  }
}

}  // namespace
}  // namespace cabinet_articulation::core
