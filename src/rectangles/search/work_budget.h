// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace cabinet_articulation::core {

/// How much of a frame's time budget is spent (ours). Work is counted and priced, not timed: the same input takes the same
/// decisions on every run and on every computer. Prices are milliseconds on a core of 2 to 3 GHz.
class WorkBudget {
 public:
  /// `milliseconds`: 0 for no limit.
  explicit WorkBudget(double milliseconds) : limit_(milliseconds) {}

  void addRegion() { spent_ += kRegion; }
  void addRows(std::int64_t rows) { spent_ += kRow * static_cast<double>(rows); }
  void addRefinement() { spent_ += kRefinement; }

  double spent() const { return spent_; }  ///< [ms]
  bool exhausted() const { return limit_ > 0 && spent_ >= limit_; }

 private:
  static constexpr double kRegion = 0.02;      ///< outline, chart and counting labels
  static constexpr double kRow = 4e-6;         ///< one image row of one rectangle in the search
  static constexpr double kRefinement = 0.35;  ///< plane, edges and covariance of one rectangle

  double limit_;
  double spent_ = 0;
};

}  // namespace cabinet_articulation::core
