// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/front_drawing.h"

#include <algorithm>

#include "cabinet_articulation/joints/joint.h"

namespace cabinet_articulation {
namespace {

constexpr int kDashes = 8;
constexpr float kFaint = 0.15F;  ///< opacity of a surface behind its edges

void addEdge(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double observed, const Paint& paint, Drawing* drawing) {
  const double share = observed > 0 ? std::min(observed, 1.0) : 0;
  if (share <= 0) return;
  const Eigen::Vector3d step = (to - from) / kDashes;
  if (share >= 1) {
    drawing->lines.push_back({from, to, paint});
    return;
  }
  for (int i = 0; i < kDashes; ++i) {
    const Eigen::Vector3d middle = from + (i + 0.5) * step;
    drawing->lines.push_back({middle - share / 2 * step, middle + share / 2 * step, paint});
  }
}

void addObservedEdges(const core::Rectangle& rectangle, const std::array<float, 4>& support, const Paint& paint,
                      Drawing* drawing) {
  const auto corners = rectangle.corners();
  addEdge(corners[3], corners[0], support[core::kEdgeMinusX], paint, drawing);
  addEdge(corners[1], corners[2], support[core::kEdgePlusX], paint, drawing);
  addEdge(corners[0], corners[1], support[core::kEdgeMinusY], paint, drawing);
  addEdge(corners[2], corners[3], support[core::kEdgePlusY], paint, drawing);
}

/// `share` is how far along the track the observation is, by time.
Color colorOf(const core::Track& track, const core::LearnedModel* model, ColorBy color_by, double share) {
  if (color_by == ColorBy::kId) return colorOfId(track.id);
  if (color_by == ColorBy::kTime) return colorOfShare(share);
  return model ? colorOf(*model, color_by, 0) : core::palette::kGrey;
}

void addObservation(const core::Rectangle& front, const std::array<float, 4>& support, ObservationStyle style, const Paint& paint,
                    Drawing* drawing) {
  switch (style) {
    case ObservationStyle::kRectangle:
      return addObservedEdges(front, support, paint, drawing);
    case ObservationStyle::kCross:
      return addCross(front, paint, drawing);
    case ObservationStyle::kAxes:
      return addFrame(front, paint.alpha, drawing);
    case ObservationStyle::kLine:
      return;
  }
}

}  // namespace

void drawRectangles(const std::vector<core::DetectedRectangle>& rectangles, ColorBy color_by, Drawing* drawing) {
  for (const core::DetectedRectangle& seen : rectangles) {
    Paint paint{kRectangleColor};
    if (color_by == ColorBy::kProbability) paint.color = colorOfShare(seen.precision);
    addObservedEdges(seen.rectangle, seen.edge_support, paint, drawing);
    addSurface(seen.rectangle, {paint.color, kFaint}, drawing);
  }
}

std::vector<std::size_t> sampledObservations(const core::Track& track, double density) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < track.observations.size(); ++i) {
    const Eigen::Vector3d center = track.observations[i].rectangle.center();
    const bool end = i == 0 || i + 1 == track.observations.size();
    const bool moved_on =
        end || density <= 0 || (center - track.observations[chosen.back()].rectangle.center()).norm() * density >= 1;
    if (moved_on) chosen.push_back(i);
  }
  return chosen;
}

void drawTrack(const core::Track& track, const core::LearnedModel* model, const TrackStyle& style, Drawing* drawing) {
  if (track.observations.empty()) return;
  // What hangs on another front has its model in that one's frame, which moved while the track was seen.
  const bool onto_model = style.projected && model && model->parent == 0 && isJoint(*model);
  const double first = track.observations.front().stamp, newest = track.observations.back().stamp;
  std::vector<Eigen::Vector3d> way;
  for (const std::size_t i : sampledObservations(track, style.density)) {
    const core::TrackedObservation& seen = track.observations[i];
    const bool last = i + 1 == track.observations.size();
    core::Rectangle front = seen.rectangle;
    if (onto_model) front.pose = model->predict(model->configuration(front.pose));
    const double share = newest > first ? (seen.stamp - first) / (newest - first) : 1;
    const Paint paint{colorOf(track, model, style.color_by, share), last ? 1.0F : style.alpha};
    way.push_back(front.center());
    if (style.latest_only && !last) continue;
    addObservation(front, seen.edge_support, style.observations, paint, drawing);
    if (last) drawing->texts.push_back({front.center(), std::to_string(track.id), paint});
  }
  if (!style.latest_only) addPath(way, {colorOf(track, model, style.color_by, 1), style.alpha}, drawing);
}

}  // namespace cabinet_articulation
