// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "planes/plane_fit.h"
#include "planes/region_growing.h"

namespace cabinet_articulation::core {

/// Two planes in one region. Either they meet: the first one's surface ends there, and the second one's may reach around it. Or
/// they are parallel, a step apart at a straight edge across the region.
struct Fold {
  DisparityPlane first, second;
  double first_sign = 1;  ///< of first - second on the first one's side of where they meet
  bool is_step = false;

  /// [px] distance of the planes, positive on the first one's side of the line where they meet.
  double ahead(double u, double v) const { return first_sign * (first.at(u, v) - second.at(u, v)); }
};

/// Tells a bent or stepped region from a flat one (ours). A door that has just opened leaves the plane of its neighbour at the
/// hinge by less than any tolerance. A sliding door is before the other one by less. So one region holds both, and its plane is
/// neither's.
class FoldSearch {
 public:
  /// The two planes that explain the region's cells best. Nothing unless they do so significantly better than one plane does.
  ///
  /// A fold must also stand apart on both sides of the line where the planes meet. It does so by more than a calibration bends a
  /// plane, and than a depth camera `may_bend` one [px]; 0 for a pair.
  ///
  /// A step is a jump all along its edge, by as much as the two planes are apart, and by more than a calibration bends a plane.
  /// What is bent or round does not jump. A camera that bends by 0.75 px over half an image bends by 0.11 px over the 48 px that
  /// are looked at. A front that its neighbours surround has no such edge.
  std::optional<Fold> process(const cv::Mat1f& cells, const GrownRegion& region, const RegionSet& set, double may_bend);

  /// Whether a cell with this disparity is on the first surface of `fold`, the last one found, for sure or rather than on the
  /// second; and likewise for the second. Where planes meet both may be.
  bool mayBeFirst(const Fold& fold, int row, int col, double disparity) const;
  bool mayBeSecond(const Fold& fold, int row, int col, double disparity) const;

 private:
  static constexpr int kBlock = 8;  ///< [cells] side of what belongs to one plane as a whole

  /// Two fits side by side.
  struct Halves {
    PlaneFit first, second;
    Fold fold;           ///< of residuals
    double squares = 0;  ///< [px^2] that both leave
    double angle = 0;    ///< [rad] across the line between them, if it was a line
    int bin = 0;         ///< of the first blocks behind it
  };

  /// Of residuals, across an edge.
  struct Jump {
    double mean = 0;  ///< [px]
    double gain = 0;  ///< twice the logarithm of how much likelier the two planes make it than none
  };

  enum Side : std::uint8_t { kNone, kFirst, kSecond };

  int blockOf(int row, int col) const { return row / kBlock * grid_.width + col / kBlock; }
  int binOf(int block, double cos, double sin) const;
  void fillBlocks(const cv::Mat1f& cells, const GrownRegion& region, const RegionSet& set);
  std::optional<Halves> bestLine();
  std::optional<Halves> bestLine(double angle);
  std::optional<Halves> improve(Halves halves);
  bool isFirst(const PlaneFit& block, const Fold& fold) const;
  static std::optional<Halves> solve(const PlaneFit& first, const PlaneFit& second);
  static std::optional<Halves> solveParallel(const Halves& line);
  double apart(const Fold& fold) const;
  bool isSignificant(const Halves& halves) const;
  std::optional<Fold> foldNear(const Halves& line, double may_bend);
  std::optional<Fold> stepAt(const Halves& line);
  Jump jumpAcross(const Fold& step) const;
  void markNear(Side side, std::vector<std::uint8_t>* near) const;

  cv::Size grid_;
  std::vector<PlaneFit> blocks_, bins_, before_;
  std::vector<int> filled_;                             ///< blocks of the region
  PlaneFit all_;                                        ///< of them
  double flat_squares_ = 0;                             ///< [px^2] that one plane leaves
  std::vector<Side> sides_;                             ///< of each block
  std::vector<std::uint8_t> near_first_, near_second_;  ///< of each block
};

}  // namespace cabinet_articulation::core
