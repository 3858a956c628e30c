// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "cabinet_articulation/rectangles/rectangles_config.h"
#include "rectangles/chart/plane_chart.h"

namespace cabinet_articulation::core {

/// Pixels of a rectangle by label. Only pixels inside the image are counted.
struct LabelCounts {
  int in_plane = 0, free = 0, occluded = 0, unknown = 0, other_plane = 0;
  int hole = 0;  ///< says nothing about the front

  int total() const { return in_plane + free + occluded + unknown + other_plane; }
};

/// How well a rectangle fits the mask of one region; the greedy search maximises it.
///
/// `label_weights` (ours): the sum of a weight per pixel. In-plane pixels gain 1, so that growing over them always pays. Eq. (3)
/// taken literally does not offer this: with cost(in-plane) = 0 every all-in-plane rectangle scores 0.
/// `paper`: sum(1 - cost) / pixels^(1 - alpha), the form of Eq. (3) in the original release, which also rejects
/// rectangles that leave the image.
///
/// A candidate costs two look-ups per image row in prefix sums over the rows, which are built where and when they are first
/// needed.
class RectangleObjective {
 public:
  explicit RectangleObjective(const RectanglesConfig& config);

  /// The mask must stay alive and unchanged while the objective is used.
  void setMask(const cv::Mat1b& mask);

  /// Minus infinity where the objective does not allow the rectangle. A `row_step` above 1 looks at every so many rows
  /// only and scales the result: a faster look for steps of many pixels. Compare gains of equal row steps only.
  double gain(const ImageQuad& quad, int row_step = 1) const;

  LabelCounts count(const ImageQuad& quad) const;

  /// Image rows that gain() has looked at so far: the measure of a search's work.
  std::int64_t rowsSeen() const { return rows_seen_; }

 private:
  /// The part of a row whose sums are ready.
  struct Range {
    int begin = 0, end = 0;
  };

  /// Sums over row v, ready at least from u_begin to u_end; only their differences mean something.
  const std::int32_t* rowSums(int v, int u_begin, int u_end) const;
  void extend(int v, int u_begin, int u_end) const;

  bool paper_;
  double alpha_;
  double outside_weight_;
  std::vector<std::int32_t> weights_;  ///< of each label value, in units of 1 / kWeightScale
  cv::Mat1b mask_;
  mutable std::vector<std::int32_t> sums_;  ///< [v][u]: the weights of row v left of u, up to a constant of the row
  mutable std::vector<Range> ready_;        ///< of each row
  mutable std::int64_t rows_seen_ = 0;
};

}  // namespace cabinet_articulation::core
