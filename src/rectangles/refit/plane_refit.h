// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "planes/photometric_refinement.h"
#include "rectangles/chart/rectangle_candidate.h"

namespace cabinet_articulation::core {

/// Refines the planes of small candidates once more, on the pixels of their rectangles (ours). Block matching finds only
/// part of a far front, and its regions reach over the front's edges; both tilt the plane. The rectangle knows better
/// which pixels belong to the plane: beyond 2.2 m the normal's error falls from some 10 degrees to 2-6.
class PlaneRefit {
 public:
  /// Of the settings, `refine_iterations`, `refine_pixels` and `refine_max_shift` matter: they are those of the planes stage.
  explicit PlaneRefit(const PlanesConfig& config);

  /// Without images nothing changes. The rectangles keep their corners in the image.
  void process(const DepthFrame& frame, std::vector<RectangleCandidate>* candidates);

 private:
  void refit(const DepthFrame& frame, double most, std::vector<RectangleCandidate>* candidates);

  struct Small {
    RectangleCandidate* candidate;
    ImageQuad quad;  ///< [px] of its rectangle
  };

  PhotometricRefinement refinement_;
  std::vector<Small> small_;
  RegionSet set_;  ///< of the small ones
  cv::Mat1f tolerance_;
};

/// Gives a candidate another plane; its corners stay at `quad` in the image. False, and nothing changes, if they do not see it.
bool moveToPlane(const DisparityPlane& plane, const ImageQuad& quad, const StereoCamera& camera, RectangleCandidate* candidate);

}  // namespace cabinet_articulation::core
