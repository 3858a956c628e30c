// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "cabinet_articulation/geometry/plane.h"
#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"
#include "planes/connected_runs.h"

namespace cabinet_articulation::core {

class FoldSearch;

/// Regions live on a grid of cells of 2x2 pixels; a cell is judged by its first pixel that was measured. A quarter of the
/// pixels is plenty, because block matching makes neighbours nearly equal.
constexpr int kCell = 2;  ///< [px]

/// A connected set of cells near one plane: the runs [first_run, last_run) of its RegionSet, row by row.
struct GrownRegion {
  DisparityPlane plane;
  int first_run = 0, last_run = 0;
  int cells = 0;
};

struct RegionSet {
  std::vector<GrownRegion> regions;
  std::vector<CellRun> runs;
};

/// Splits infinite planes into connected regions, each with a plane of its own (ours: a small front that shares its plane
/// with half the kitchen is fitted by its own pixels only).
class RegionGrowing {
 public:
  explicit RegionGrowing(const PlanesConfig& config);

  /// Regions of at least `min_region` pixels, in the order of the planes. Valid until the next call.
  RegionSet& process(const DepthFrame& frame, const std::vector<DisparityPlane>& planes);

  /// The last result without the cells whose residual exceeds `limit` [px, for each cell], and refitted.
  RegionSet& trim(const cv::Mat1f& limit);

  /// The last result with two regions in place of each that is bent, grown from the planes on either side of its fold.
  /// `may_bend`: as FoldSearch.
  RegionSet& unfold(const StereoCamera& camera, double may_bend, FoldSearch* search);

  /// The disparity of each cell; negative and infinite where nothing was measured.
  const cv::Mat1f& cells() const { return disparity_; }

 private:
  void addComponents(const DisparityPlane& plane, const cv::Range& rows);
  void shrinkDisparity(const cv::Mat1f& disparity);
  void markInPlane(const DisparityPlane& plane, const StereoCamera& camera);
  std::optional<DisparityPlane> fitPlane(const ConnectedRuns::Component& core) const;
  template <class Predicate>
  void clear(const GrownRegion& region, const Predicate& out);
  void addPart(const GrownRegion& whole, const DisparityPlane& plane);
  GrownRegion growBack(const ConnectedRuns::Component& core);

  PlanesConfig config_;
  RegionSet set_, untrimmed_;
  ConnectedRuns cores_;
  cv::Mat1f disparity_;  ///< one value for each cell
  cv::Mat1b in_plane_, eroded_, grown_;
};

}  // namespace cabinet_articulation::core
