// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>

namespace cabinet_articulation::core {

/// The weighted median of any number of lengths, in bounded memory (a histogram of tenths of a millimetre).
/// Ours: one wrong frame in three does not move it, and it is defined as soon as there is one length of any weight.
class LengthEstimate {
 public:
  /// A length [m] > 0 with a weight in [0, 1]; weight 0 counts only as long as nothing better was seen.
  void add(double length, double weight);

  /// [m]; 0 while empty.
  double median() const { return quantile(0.5); }

  /// [m] half the width of the central 68 %.
  double spread() const { return (quantile(0.84) - quantile(0.16)) / 2; }

  /// How many fully observed lengths the estimate rests on.
  double weight() const { return weight_; }

 private:
  double quantile(double share) const;

  std::map<int, double> histogram_;
  double weight_ = 0;
};

}  // namespace cabinet_articulation::core
