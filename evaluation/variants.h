// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "cabinet_articulation/pipeline/pipeline.h"

namespace cabinet_articulation::core::evaluation {

/// One way to detect fronts.
struct Variant {
  std::string name;
  PipelineConfig config;
  bool tracks_guide = true;  ///< live tracks propose their fronts to the detector
};

/// The defaults.
Variant ourVariant();

/// The paper's III-B: infinite planes within d = 2 cm, Eq. (3), several random starts in each plane, precision and recall of
/// the whole plane above 0.7, corners inside the image, no refinement on the images, no feedback.
Variant paperVariant();

}  // namespace cabinet_articulation::core::evaluation
