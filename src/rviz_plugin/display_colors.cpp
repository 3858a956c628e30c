// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/display_colors.h"

#include <algorithm>
#include <array>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation {
namespace {

namespace palette = core::palette;

constexpr std::array<Color, 7> kOfIds{palette::kSkyBlue, palette::kOrange,    palette::kBluishGreen,  palette::kYellow,
                                      palette::kBlue,    palette::kVermilion, palette::kReddishPurple};
constexpr double kOld = 60;  ///< [s] ours: who works in a kitchen thinks of the last minute

}  // namespace

Color colorOfId(std::uint32_t id) { return kOfIds[id % kOfIds.size()]; }

Color colorOfShare(double share) {
  const float at = static_cast<float>(share > 0 ? std::min(share, 1.0) : 0);
  Color color{};
  for (std::size_t i = 0; i < color.size(); ++i) color[i] = (1 - at) * palette::kBlue[i] + at * palette::kYellow[i];
  return color;
}

Color colorOf(const core::LearnedModel& model, ColorBy color_by, double age) {
  switch (color_by) {
    case ColorBy::kId:
      return colorOfId(model.id);
    case ColorBy::kProbability:
      return colorOfShare(typeProbability(model));
    case ColorBy::kTime:
      return colorOfShare(1 - age / kOld);
    case ColorBy::kType:
      break;
  }
  return colorOf(model);
}

}  // namespace cabinet_articulation
