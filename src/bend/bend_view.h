// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "bend/bend_basis.h"
#include "cabinet_articulation/planes/plane_region.h"

namespace cabinet_articulation::core {

/// What one large surface says about the bend: the normal equations of least squares for its residuals, from which the plane
/// was eliminated (Schur complement). Noise counts once for each window of the sensor's matching.
struct BendView {
  Plane plane;                                  ///< in the left optical frame
  int pixels = 0;                               ///< of the region
  double windows = 0;                           ///< of them
  double squares = 0;                           ///< [px^2] that the best plane leaves, summed over windows
  BendVector gradient = BendVector::Zero();     ///< [px]
  BendMatrix information = BendMatrix::Zero();  ///< symmetric

  /// [px^2] what the best plane leaves once a bend was taken away.
  double squaresWithout(const BendVector& bend) const { return squares - 2 * gradient.dot(bend) + bend.dot(information * bend); }
};

/// Makes views from regions; keeps its buffers.
class BendSurvey {
 public:
  /// Nothing for a region that is too slender for a plane. `disparity` is as it was measured, without any correction.
  std::optional<BendView> process(const cv::Mat1f& disparity, const PlaneRegion& region);

 private:
  BendBasis basis_;
  cv::Mat1b inside_;  ///< the region's hull: in-plane pixels elsewhere may be of another surface
};

/// Whether a region is so large that bends show in it.
bool showsBend(const PlaneRegion& region);

/// Whether two views are of one and the same sight: a plane that stood where it stands now shows the same surface at the same
/// place in the image, folds and all.
bool sameSight(const Plane& a, const Plane& b);

}  // namespace cabinet_articulation::core
