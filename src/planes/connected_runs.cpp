// SPDX-License-Identifier: BSD-3-Clause
#include "planes/connected_runs.h"

#include <cstring>

namespace cabinet_articulation::core {

void appendRuns(const std::uint8_t* cells, int n, int row, std::vector<CellRun>* runs) {
  const std::uint8_t* const end = cells + n;
  const std::uint8_t* cell = cells;
  while (cell < end) {
    const void* const found = std::memchr(cell, 255, end - cell);
    if (!found) return;
    const auto* const begin = static_cast<const std::uint8_t*>(found);
    const void* const stop = std::memchr(begin, 0, end - begin);
    cell = stop ? static_cast<const std::uint8_t*>(stop) : end;
    runs->push_back({row, static_cast<int>(begin - cells), static_cast<int>(cell - cells)});
  }
}

void ConnectedRuns::process(const cv::Mat1b& mask, const cv::Range& rows) {
  scanned_.clear();
  parent_.clear();
  int previous = 0;
  for (int row = rows.start; row < rows.end; ++row) {
    const int current = static_cast<int>(scanned_.size());
    appendRuns(mask[row], mask.cols, row, &scanned_);
    const int end = static_cast<int>(scanned_.size());
    for (int run = current; run < end; ++run) parent_.push_back(run);
    joinRows(previous, current, end);
    previous = current;
  }
  sortByComponent();
}

/// Runs previous..current-1 are one row's, current..end-1 the next row's (or the row above has none).
void ConnectedRuns::joinRows(int previous, int current, int end) {
  int above = previous, below = current;
  while (above < current && below < end) {
    const CellRun& a = scanned_[above];
    const CellRun& b = scanned_[below];
    if (a.begin < b.end && b.begin < a.end) {
      const int first = root(above), second = root(below);
      parent_[std::max(first, second)] = std::min(first, second);
    }
    a.end < b.end ? ++above : ++below;
  }
}

int ConnectedRuns::root(int run) {
  while (parent_[run] != run) run = parent_[run] = parent_[parent_[run]];
  return run;
}

void ConnectedRuns::sortByComponent() {
  components_.clear();
  component_.resize(scanned_.size());
  for (size_t run = 0; run < scanned_.size(); ++run) {
    const int first = root(static_cast<int>(run));
    if (first == static_cast<int>(run)) {
      component_[run] = static_cast<int>(components_.size());
      components_.emplace_back();
    }
    component_[run] = component_[first];
    Component& component = components_[component_[run]];
    ++component.last_run;
    component.cells += scanned_[run].end - scanned_[run].begin;
  }
  int first_run = 0;
  for (Component& component : components_) {
    const int n = component.last_run;
    component.first_run = component.last_run = first_run;
    first_run += n;
  }
  runs_.resize(scanned_.size());
  for (size_t run = 0; run < scanned_.size(); ++run) runs_[components_[component_[run]].last_run++] = scanned_[run];
}

}  // namespace cabinet_articulation::core
