// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

/// Colours that people with any kind of colour vision tell apart: M. Okabe and K. Ito, "Color Universal Design", 2008. What is
/// drawn takes its colours from here, whether it is drawn into an image, for RViz or in a report. Red, green, blue from 0 to 1.
namespace cabinet_articulation::core::palette {

using Rgb = std::array<float, 3>;

constexpr Rgb kOrange{0.90F, 0.62F, 0.00F};
constexpr Rgb kSkyBlue{0.34F, 0.71F, 0.91F};
constexpr Rgb kBluishGreen{0.00F, 0.62F, 0.45F};
constexpr Rgb kYellow{0.94F, 0.89F, 0.26F};
constexpr Rgb kBlue{0.00F, 0.45F, 0.70F};
constexpr Rgb kVermilion{0.84F, 0.37F, 0.00F};
constexpr Rgb kReddishPurple{0.80F, 0.47F, 0.65F};
constexpr Rgb kGrey{0.70F, 0.70F, 0.70F};  ///< ours, for what says nothing yet

}  // namespace cabinet_articulation::core::palette
