// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/speckle_filter.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace cabinet_articulation::core {
namespace {

/// `joined` has room for a pixel after the last one, which is joined to nothing.
__attribute__((target_clones("avx2", "default"))) void compareNeighbours(const std::int16_t* __restrict row, int n, int range,
                                                                         std::int16_t unmatched, std::uint8_t* __restrict matched,
                                                                         std::uint8_t* __restrict joined) {
  for (int u = 0; u < n; ++u) matched[u] = row[u] != unmatched ? 255 : 0;
  for (int u = 1; u < n; ++u) joined[u] = std::abs(row[u] - row[u - 1]) <= range ? 255 : 0;
  for (int u = 1; u < n; ++u) joined[u] &= matched[u] & matched[u - 1];
  joined[n] = 0;
}

}  // namespace

void SpeckleFilter::process(int size, int range, std::int16_t unmatched, cv::Mat1s* sixteenths) {
  const int columns = sixteenths->cols;
  matched_.resize(columns);
  joined_.resize(columns + 1);
  runs_.clear();
  int first_above = 0;
  for (int v = 0; v < sixteenths->rows; ++v) {
    const auto first = static_cast<int>(runs_.size());
    const std::int16_t* row = (*sixteenths)[v];
    compareNeighbours(row, columns, range, unmatched, matched_.data(), joined_.data());
    appendRuns(v);
    if (v > 0) joinRows((*sixteenths)[v - 1], row, range, first_above, first);
    first_above = first;
  }
  for (size_t i = 0; i < runs_.size(); ++i) {
    const Run& run = runs_[i];
    std::int16_t* const row = (*sixteenths)[run.row];
    if (runs_[root(static_cast<int>(i))].pixels <= size) std::fill(row + run.begin, row + run.end, unmatched);
  }
}

void SpeckleFilter::appendRuns(int v) {
  const std::uint8_t *const matched = matched_.data(), *const joined = joined_.data();
  const auto columns = static_cast<int>(matched_.size());
  for (int begin = 0, end = 0; begin < columns; begin = end) {
    const void* const found = std::memchr(matched + begin, 255, columns - begin);
    if (!found) return;
    begin = static_cast<int>(static_cast<const std::uint8_t*>(found) - matched);
    const void* const next = std::memchr(joined + begin + 1, 0, columns - begin);
    end = static_cast<int>(static_cast<const std::uint8_t*>(next) - joined);
    const auto index = static_cast<int>(runs_.size());
    runs_.push_back({v, begin, end, index, end - begin});
  }
}

/// The runs from `first_above` on are one row's, those from `first_below` on the next row's.
void SpeckleFilter::joinRows(const std::int16_t* above, const std::int16_t* below, int range, int first_above, int first_below) {
  const auto end = static_cast<int>(runs_.size());
  for (int a = first_above, b = first_below; a < first_below && b < end;) {
    const int first = std::max(runs_[a].begin, runs_[b].begin), last = std::min(runs_[a].end, runs_[b].end);
    for (int u = first; u < last; ++u) {
      if (std::abs(above[u] - below[u]) > range) continue;
      join(a, b);
      break;
    }
    runs_[a].end < runs_[b].end ? ++a : ++b;
  }
}

void SpeckleFilter::join(int a, int b) {
  a = root(a);
  b = root(b);
  if (a == b) return;
  runs_[std::max(a, b)].parent = std::min(a, b);
  runs_[std::min(a, b)].pixels += runs_[std::max(a, b)].pixels;
}

int SpeckleFilter::root(int run) {
  while (runs_[run].parent != run) run = runs_[run].parent = runs_[runs_[run].parent].parent;
  return run;
}

}  // namespace cabinet_articulation::core
