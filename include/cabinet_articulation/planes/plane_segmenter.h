// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// [px] Most by which a depth camera bends what is flat, until its bend is known. Measured: a PrimeSense before a flat board.
constexpr double kMostBend = 0.75;

/// Paper III-B.1: the planes of a frame and their masks. Buffers are kept between frames, and so is the memory of the masks
/// that nobody holds any more.
class PlaneSegmenter {
 public:
  explicit PlaneSegmenter(const PlanesConfig& config);
  ~PlaneSegmenter();

  /// The regions, largest first. An empty or all-invalid disparity gives none. The same frame gives the same regions,
  /// whatever came before. Throws std::invalid_argument if there are images of another size than the disparity.
  /// `may_bend`: what a depth camera may still bend of what is flat [px]; a fold stands out by more. Pairs do not.
  std::vector<PlaneRegion> process(const DepthFrame& frame, double may_bend = kMostBend);

 private:
  std::vector<PlaneRegion> connectedRegions(const DepthFrame& input, double may_bend);
  std::vector<PlaneRegion> wholePlanes(const DepthFrame& frame) const;

  struct Buffers;
  PlanesConfig config_;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace cabinet_articulation::core
