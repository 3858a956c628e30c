// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/planes/planes_config.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/rectangles/rectangles_config.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

struct RectangleCandidate;
struct SupportedRectangle;
struct Surroundings;

/// Paper III-B.2: at most one rectangle in each plane region.
class RectangleDetector {
 public:
  /// `planes`: the settings of the planes stage, by which planes of small rectangles are refined once more.
  /// Throws ConfigError for a value out of range.
  RectangleDetector(const RectanglesConfig& config, const PlanesConfig& planes);
  ~RectangleDetector();

  /// `tracks`: where they are now (left optical frame); each proposes its own size at its place, unless `use_tracks` is false.
  /// Without images in the frame the photometric edge refinement is skipped. The same input gives the same output, best
  /// supported rectangle first. Throws std::invalid_argument if images or masks differ in size from the camera.
  std::vector<DetectedRectangle> process(const DepthFrame& frame, const std::vector<PlaneRegion>& regions,
                                         const std::vector<Rectangle>& tracks = {});

 private:
  struct Buffers;
  /// At most one candidate per region, by its mask alone; within the time budget.
  void search(const StereoCamera& camera, const std::vector<PlaneRegion>& regions, const std::vector<Rectangle>& expected);
  /// Edges from the images, acceptance and covariance.
  std::optional<SupportedRectangle> refine(const Surroundings& surroundings, const std::vector<Rectangle>& expected,
                                           RectangleCandidate* candidate);

  RectanglesConfig config_;
  std::unique_ptr<Buffers> buffers_;
};

}  // namespace cabinet_articulation::core
