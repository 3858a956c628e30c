// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "cabinet_articulation/articulation/learned_model.h"
#include "ros/drawing/model_drawing.h"

namespace cabinet_articulation {

/// What the colour of a front tells.
enum class ColorBy { kId = 0, kType, kProbability, kTime };

/// Fronts with ids that follow one another differ.
Color colorOfId(std::uint32_t id);

/// From blue (0) to yellow (1), which people with any kind of colour vision tell apart.
Color colorOfShare(double share);

/// `age` is seconds between the newest observation of any front and the newest of this one.
Color colorOf(const core::LearnedModel& model, ColorBy color_by, double age);

}  // namespace cabinet_articulation
