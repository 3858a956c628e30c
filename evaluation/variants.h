// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/pipeline/pipeline.h"
#include "frame_source.h"

namespace cabinet_articulation::core::evaluation {

/// One way to detect fronts: the pipeline's settings, and what it is given.
struct Variant {
  std::string name;
  PipelineConfig config;
  bool tracks_guide = true;  ///< live tracks propose their fronts to the detector
  bool from_depth = false;   ///< gets a depth image in place of the stereo pair
};

/// The defaults.
Variant ourVariant();

/// The defaults behind a camera that delivers depth: block matching's, holes included, in whole millimetres.
Variant depthVariant();

/// The paper's III-B: infinite planes within d = 2 cm, Eq. (3), several random starts in each plane, precision and recall of
/// the whole plane above 0.7, corners inside the image, no refinement on the images, no feedback.
Variant paperVariant();

/// A pipeline that is shown frames as its variant says.
class Observer {
 public:
  explicit Observer(const Variant& variant);

  const std::string& name() const { return variant_.name; }
  PipelineResult see(const Frame& frame, const StereoCamera& camera);

  /// The next frame has nothing to do with the ones before.
  void forget() { pipeline_.reset(); }

 private:
  Variant variant_;
  BlockMatcher matcher_;
  Pipeline pipeline_;
};

}  // namespace cabinet_articulation::core::evaluation
