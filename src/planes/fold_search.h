// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "planes/plane_fit.h"
#include "planes/region_growing.h"

namespace cabinet_articulation::core {

/// Two planes that meet in a region. The first one's surface ends where they meet; the second one's may reach around it.
struct Fold {
  DisparityPlane first, second;
  double first_sign = 1;  ///< of first - second on the first one's side

  /// [px] distance of the planes, positive on the first one's side of the line where they meet.
  double ahead(double u, double v) const { return first_sign * (first.at(u, v) - second.at(u, v)); }
};

/// Tells a bent region from a flat one (ours: a door that has just opened leaves the plane of its neighbour at the hinge by
/// less than any tolerance, so one region holds both and its plane is neither's).
class FoldSearch {
 public:
  /// The two planes that explain the region's cells best. Nothing unless they do so significantly better than one plane
  /// does. They must also stand apart on both sides of the line where they meet. They do so by more than a calibration bends a
  /// plane, and than a depth camera `may_bend` one [px]; 0 for a pair.
  std::optional<Fold> process(const cv::Mat1f& cells, const GrownRegion& region, const RegionSet& set, double may_bend);

  /// Whether a cell is on the last fold's first surface, or so near to it that blocks do not tell.
  bool nearFirst(int row, int col) const { return near_first_[blockOf(row, col)] != 0; }

 private:
  static constexpr int kBlock = 8;  ///< [cells] side of what belongs to one plane as a whole

  /// Two fits side by side.
  struct Halves {
    PlaneFit first, second;
    Fold fold;           ///< of residuals
    double squares = 0;  ///< [px^2] that both leave
  };

  int blockOf(int row, int col) const { return row / kBlock * grid_.width + col / kBlock; }
  void fillBlocks(const cv::Mat1f& cells, const GrownRegion& region, const RegionSet& set);
  std::optional<Halves> bestLine();
  std::optional<Halves> bestLine(double angle);
  std::optional<Halves> improve(Halves halves);
  bool isFirst(const PlaneFit& block, const Fold& fold) const;
  static std::optional<Halves> solve(const PlaneFit& first, const PlaneFit& second);
  double apart(const Fold& fold) const;
  void markFirst(const Fold& fold);

  cv::Size grid_;
  std::vector<PlaneFit> blocks_, bins_, before_;
  std::vector<int> filled_;               ///< blocks of the region
  std::vector<std::uint8_t> near_first_;  ///< of each block
};

}  // namespace cabinet_articulation::core
