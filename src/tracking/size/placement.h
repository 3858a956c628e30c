// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cabinet_articulation/rectangles/detected_rectangle.h"
#include "cabinet_articulation/tracking/tracking_config.h"

namespace cabinet_articulation::core {

/// Description k of a detection (see `describe`), with its edges renamed accordingly.
DetectedRectangle describe(const DetectedRectangle& detection, int k);

/// What is known about a front's width and height [m].
struct KnownSize {
  Eigen::Vector2d value;
  Eigen::Vector2d sigma;
};

/// Where a front was, and how certain that is [m^2].
struct KnownPlace {
  Rectangle rectangle;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Standard deviation [m] of the place of an edge of which this share was observed: edge_sigma from four fifths on,
/// unseen_edge_sigma at zero, and a power law between them, as measured.
double edgeSigma(double support, const TrackingConfig& config);

/// Where a front of known size is, when `detection` shows it with a size of its own (ours). Along each axis the two edges,
/// each as certain as it was observed, and the known length are reconciled by least squares: an unobserved edge follows
/// from its opposite one and the known length. Edges that contradict the length become uncertain together. The place
/// `expected` (may be null) counts with a standard deviation of position_tolerance beside its own: less than any edge that
/// was observed, and more than one that was not, so that an edge that slides unseen cannot look like motion. The covariance
/// says how certain the place is.
DetectedRectangle placeOnObservedEdges(const DetectedRectangle& detection, const KnownSize& size, const KnownPlace* expected,
                                       const TrackingConfig& config);

/// The same without the covariance, which takes most of the time.
Rectangle placeRectangle(const DetectedRectangle& detection, const KnownSize& size, const KnownPlace* expected,
                         const TrackingConfig& config);

}  // namespace cabinet_articulation::core
