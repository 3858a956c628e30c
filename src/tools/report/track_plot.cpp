// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/track_plot.h"

#include <algorithm>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/joint.h"
#include "tools/report/front_charts.h"
#include "tools/report/image_canvas.h"
#include "tools/terminal/words.h"

namespace cabinet_articulation {
namespace {

constexpr double kWidth = 620, kHeight = 420, kHeading = 34;  ///< [px] of a chart and of the line above all
constexpr std::size_t kSteps = 200;                           ///< learned tracks on the way to the whole one (ours)

/// The track as it grew, with `step` observations more each time.
FrontRecord learnInSteps(const core::Track& track, const core::ArticulationConfig& config) {
  FrontRecord front;
  core::ArticulationLearner learner(config);
  core::Track part = track;
  part.observations.clear();
  const std::size_t all = track.observations.size(), step = std::max<std::size_t>(1, all / kSteps);
  for (std::size_t i = 0; i < all; ++i) {
    const core::TrackedObservation& observation = track.observations[i];
    part.observations.push_back(observation);
    front.observations.add({observation.stamp, observation.rectangle, observation.edge_support});
    if ((i + 1) % step != 0 && i + 1 != all) continue;
    const std::vector<core::LearnedModel> models = learner.process({part});
    if (models.empty()) continue;
    front.model = models.front();
    front.opinions.add({observation.stamp, front.model.probabilities});
    if (!front.first_joint && core::isJoint(front.model)) front.first_joint = observation.stamp;
  }
  return front;
}

std::string summaryOf(const core::LearnedModel& model) {
  if (!model.moved) return "did not move";
  if (!core::wasJoint(model)) return "moved, but no joint fits";
  return core::modelName(model.type) + (", " + shownRange(model)) + format(", residuals %.1f mm", 1000 * model.position_error);
}

}  // namespace

cv::Mat3b plotTrack(const core::Track& track, const core::ArticulationConfig& config, const std::string& title) {
  const FrontRecord front = learnInSteps(track, config);
  const Viewpoint view = alongTheMotion(front, -Eigen::Vector3d::UnitY());
  const double last = std::max(1.0, static_cast<double>(track.observations.size()) - 1);
  const TimeAxis time{"observation", {0, last}, 1};
  ImageCanvas canvas(static_cast<int>(2 * kWidth), static_cast<int>(2 * kHeight + kHeading));
  canvas.text({kWidth, 0.7 * kHeading}, title + ": " + summaryOf(front.model), Anchor::kMiddle, true);
  drawChart(topChart(front, view), {0, kHeading, kWidth, kHeight}, &canvas);
  drawChart(sideChart(front, view), {kWidth, kHeading, kWidth, kHeight}, &canvas);
  drawChart(openingChart(front, time), {0, kHeading + kHeight, kWidth, kHeight}, &canvas);
  drawChart(probabilityChart(front, time), {kWidth, kHeading + kHeight, kWidth, kHeight}, &canvas);
  return canvas.image();
}

}  // namespace cabinet_articulation
