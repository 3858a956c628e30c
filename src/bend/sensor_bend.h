// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "bend/bend_correction.h"
#include "bend/bend_view.h"
#include "cabinet_articulation/planes/plane_region.h"
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "cabinet_articulation/stereo/depth_frame.h"

namespace cabinet_articulation::core {

/// A bend that was learned, and of what camera.
struct KnownBend {
  StereoCamera camera;
  BendVector bend = BendVector::Zero();
  std::size_t views = 0;         ///< that it is known from
  double remaining = kMostBend;  ///< [px] that may be left of it
};

/// Learns while running how a depth camera bends what is flat: a smooth error of the disparity [px] that is fixed in the image.
/// Large surfaces show it, each sight of them once (sameSight), so a camera that stands still before a door ajar learns nothing.
/// Pairs of images are left alone, for their planes are refined on the images.
///
/// A camera that always looks at one and the same fold in the middle of its image may still mistake a part of it for a bend.
///
/// Memory is bounded: the newest 200 views are kept (300 kB). A new view takes some 1 ms, any other frame 0.2 ms.
class SensorBend {
 public:
  /// Begins with what an earlier run learned. It holds for its camera alone, and until as many views were seen again.
  void startFrom(const KnownBend& earlier);

  /// The frame without the bend as known by now. Another camera or size of images begins anew.
  DepthFrame correct(const DepthFrame& frame);

  /// To be called with the frame as it came, and the regions of the corrected one.
  void learn(const DepthFrame& frame, const std::vector<PlaneRegion>& regions);

  /// What correct() takes away; 0 until it is known.
  const BendVector& bend() const { return bend_; }

  bool isKnown() const { return !bend_.isZero(0); }

  /// From views of this run, not of an earlier one.
  bool isOwn() const { return earlier_views_ == 0; }

  /// [px] anywhere in the image.
  double largest() const { return isKnown() ? correction_.largest() : 0; }

  /// [px] By which a corrected frame may still be bent, anywhere in the image: two standard deviations. kMostBend until it is
  /// known.
  double remaining() const { return isKnown() ? remaining_ : kMostBend; }

  std::size_t views() const { return std::max(views_.size(), earlier_views_); }

  KnownBend known() const { return {camera_, bend_, views(), remaining()}; }

  /// The largest correction and from how many views, in words; empty before the first frame of a depth camera.
  std::string inWords() const;

 private:
  void follow(const StereoCamera& camera);
  bool add(const DepthFrame& frame, const PlaneRegion& region);

  StereoCamera camera_;
  BendCorrection correction_;
  BendSurvey survey_;
  std::vector<BendView> views_;
  std::size_t oldest_ = 0;         ///< the view that is replaced next, once there are as many as may be
  std::size_t earlier_views_ = 0;  ///< of an earlier run that knows more than this one
  BendVector bend_ = BendVector::Zero();
  double remaining_ = kMostBend;  ///< [px]
};

}  // namespace cabinet_articulation::core
