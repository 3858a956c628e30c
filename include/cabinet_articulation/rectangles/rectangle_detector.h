// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "cabinet_articulation/config/config.h"
#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

struct RectanglesConfig {
  int seed = 1;

  template <class Self, class Visitor>
  static void fields(Self& self, Visitor&& visit) {
    visit("seed", self.seed, Range{0, 2147483647}, "", "seed of the random starts");
  }
};

/// Paper III-B.2: at most a few rectangles in each plane region.
class RectangleDetector {
 public:
  explicit RectangleDetector(const RectanglesConfig& config);
  ~RectangleDetector();

  /// `expected`: where live tracks are now (left optical frame); each proposes its own size at its place.
  /// Without images in the frame the photometric edge refinement is skipped. The same input gives the same output.
  std::vector<DetectedRectangle> process(const DepthFrame& frame, const std::vector<PlaneRegion>& regions,
                                         const std::vector<Rectangle>& expected = {});

 private:
  struct Buffers;
  RectanglesConfig config_;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace cabinet_articulation::core
