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
  double median() const;

  /// [m] weighted standard deviation.
  double spread() const;

  /// The largest weight so far.
  double bestWeight() const { return best_weight_; }

  /// How many lengths of equal weight would be as many (Kish's effective sample size).
  double count() const { return squares_ > 0 ? weight_ * weight_ / squares_ : 0; }

 private:
  std::map<int, double> histogram_;
  double weight_ = 0;
  double best_weight_ = 0;
  double squares_ = 0;  ///< of the weights
  double mean_ = 0;
  double deviation_ = 0;  ///< weighted sum of squares about the mean
};

}  // namespace cabinet_articulation::core
