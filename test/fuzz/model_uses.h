// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "cabinet_articulation/joints/known_fronts.h"
#include "cabinet_articulation/kinds/joint_shape.h"

namespace cabinet_articulation::fuzz {

/// A door, a drawer and a garage door, each with a short history.
std::vector<core::KnownFront> exampleFronts();

/// These, and behind the door a drawer that hangs on it.
std::vector<core::KnownFront> hangingFronts();

std::vector<core::Track> tracksOf(const std::vector<core::KnownFront>& fronts);

/// All fronts where they were seen last.
std::vector<core::DetectedRectangle> seenAgain(const std::vector<core::KnownFront>& fronts);

/// All that is done with models once they are known: drawn, published, exported, and asked where fronts will be.
void useModels(const std::vector<core::LearnedModel>& models, const std::string& frame);

/// Saves, and reports unless they can be loaded again: what was learned is never lost.
void saveAndLoad(const std::vector<core::KnownFront>& fronts, const std::string& frame,
                 const std::vector<core::JointShape>& kinds = {});

}  // namespace cabinet_articulation::fuzz
