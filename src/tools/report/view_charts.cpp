// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/joints/joint.h"
#include "geometry/palette.h"
#include "tools/report/front_charts.h"

namespace cabinet_articulation {
namespace {

namespace palette = core::palette;

constexpr std::size_t kOutlines = 12;           ///< that can be told apart in a chart
constexpr double kShortest = 1e-6;              ///< [m]
constexpr double kAxisToRadius = 0.3;           ///< half of what is drawn of it where no size is known
constexpr float kEarly = 0.72F, kLate = 0.05F;  ///< grey of the first and the last observation
const double kNothing = std::numeric_limits<double>::quiet_NaN();

/// The part of `v` across the unit vector `n`, or anything across it.
Eigen::Vector3d across(const Eigen::Vector3d& n, const Eigen::Vector3d& v) {
  const Eigen::Vector3d part = v - n * n.dot(v);
  return part.norm() > kShortest ? Eigen::Vector3d(part.normalized()) : n.unitOrthogonal();
}

/// What one of the two views shows of a point.
struct Projection {
  Eigen::Vector3d origin, x, y;

  Eigen::Vector2d operator()(const Eigen::Vector3d& p) const { return {x.dot(p - origin), y.dot(p - origin)}; }
};

void addOutline(const core::Rectangle& rectangle, const Projection& project, Layer* layer) {
  if (rectangle.width <= 0 || rectangle.height <= 0) return;
  const auto corners = rectangle.corners();
  for (std::size_t i = 0; i <= corners.size(); ++i) layer->points.push_back(project(corners[i % corners.size()]));
  layer->points.emplace_back(kNothing, kNothing);
}

/// At even steps of the way between the first and the last.
Layer observedOutlines(const std::vector<FrontSample>& samples, const Projection& project) {
  Layer layer{Layer::kLine, "", {0.8F, 0.8F, 0.8F}, 1};
  double way = 0, next = 0;
  for (std::size_t i = 1; i < samples.size(); ++i)
    way += (samples[i].rectangle.center() - samples[i - 1].rectangle.center()).norm();
  double gone = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) gone += (samples[i].rectangle.center() - samples[i - 1].rectangle.center()).norm();
    if (gone < next) continue;
    addOutline(samples[i].rectangle, project, &layer);
    next = gone + way / static_cast<double>(kOutlines);
  }
  if (!layer.points.empty()) layer.name = "observed front";
  return layer;
}

Layer observedCentres(const std::vector<FrontSample>& samples, const Projection& project) {
  Layer layer{Layer::kDots, "observed centre, from light to dark", {0.4F, 0.4F, 0.4F}, 2};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const float share = samples.size() > 1 ? static_cast<float>(i) / static_cast<float>(samples.size() - 1) : 1;
    const float grey = kEarly + share * (kLate - kEarly);
    layer.points.push_back(project(samples[i].rectangle.center()));
    layer.colors.push_back({grey, grey, grey});
  }
  return layer;
}

void addLearned(const core::LearnedModel& model, const Projection& project, Chart* chart) {
  Layer ends{Layer::kLine, "", colorOf(model), 1.5, true};
  for (const double q : {model.q_min, model.q_max}) addOutline(frontAt(model, q), project, &ends);
  if (!ends.points.empty()) ends.name = "learned front at both ends";
  Layer way{Layer::kLine, "learned way of the centre", colorOf(model), 3};
  for (const Eigen::Vector3d& p : wayOf(model, model.q_min, model.q_max)) way.points.push_back(project(p));
  chart->layers.insert(chart->layers.end(), {ends, way});
  if (!core::modelEntry(model.type).turns) return;
  auto axis = axisOf(model);
  if ((axis.second - axis.first).norm() < kShortest) {  // of a front without a size
    axis.first -= kAxisToRadius * model.radius * model.axis;
    axis.second += kAxisToRadius * model.radius * model.axis;
  }
  Layer line{Layer::kLine, "learned axis", palette::kVermilion, 3, false, {project(axis.first), project(axis.second)}};
  Layer dot{Layer::kDots, "", palette::kVermilion, 4.5, false, {project(model.axis_point)}};
  chart->layers.insert(chart->layers.end(), {line, dot});
}

Chart viewChart(const FrontRecord& front, const Projection& project) {
  Chart chart;
  chart.equal_scales = true;
  const std::vector<FrontSample> samples = front.observations.values();
  chart.layers.push_back(observedOutlines(samples, project));
  if (core::wasJoint(front.model)) addLearned(front.model, project, &chart);
  chart.layers.push_back(observedCentres(samples, project));
  return chart;
}

}  // namespace

Viewpoint beforeTheFront(const core::LearnedModel& model, const Eigen::Vector3d& upwards) {
  const Eigen::Matrix3d axes = model.origin.linear();
  Viewpoint view{{}, axes.col(0), axes.col(2), {"From above", "From the side", "to the right [m]", "up [m]", "out [m]"}};
  for (const Eigen::Vector3d& edge : {Eigen::Vector3d(-axes.col(0)), Eigen::Vector3d(axes.col(1)), Eigen::Vector3d(-axes.col(1))})
    if (edge.dot(upwards) > view.up.dot(upwards)) view.up = edge;
  view.right = view.up.cross(view.out);
  return view;
}

Viewpoint alongTheMotion(const FrontRecord& front, const Eigen::Vector3d& upwards) {
  const core::LearnedModel& model = front.model;
  const std::vector<FrontSample> samples = front.observations.values();
  Eigen::Vector3d motion = Eigen::Vector3d::Zero();
  for (const FrontSample& sample : samples) {
    const Eigen::Vector3d moved = sample.rectangle.center() - samples.front().rectangle.center();
    if (moved.norm() > motion.norm()) motion = moved;
  }
  Viewpoint view{{}, {}, {}, {"From above", "From the side", "across the motion [m]", "up [m]", "along the motion [m]"}};
  if (core::wasJoint(model) && core::modelEntry(model.type).turns) {
    view.up = model.axis.dot(upwards) < 0 ? Eigen::Vector3d(-model.axis) : model.axis;
    view.out = across(view.up, motion);
    view.words.top = "Along the axis";
    view.words.side = "Across the axis";
    view.words.up = "along the axis [m]";
  } else {
    view.out = motion.norm() > 0 ? Eigen::Vector3d(motion.normalized()) : upwards.unitOrthogonal();
    view.up = across(view.out, upwards);
  }
  view.right = view.up.cross(view.out);
  return view;
}

std::array<Side, 4> sidesOf(const core::LearnedModel& model, const Viewpoint& view) {
  const Eigen::Matrix3d axes = model.origin.linear();
  const bool x_is_upright = std::abs(axes.col(0).dot(view.up)) > std::abs(axes.col(1).dot(view.up));
  const Eigen::Vector3d upright = x_is_upright ? axes.col(0) : axes.col(1), level = x_is_upright ? axes.col(1) : axes.col(0);
  const bool turned = upright.dot(view.up) < 0, mirrored = level.dot(view.right) < 0;
  const std::array<Side, 2> ups{turned ? kUpper : kLower, turned ? kLower : kUpper};
  const std::array<Side, 2> rights{mirrored ? kRight : kLeft, mirrored ? kLeft : kRight};
  return x_is_upright ? std::array<Side, 4>{ups[0], ups[1], rights[0], rights[1]}
                      : std::array<Side, 4>{rights[0], rights[1], ups[0], ups[1]};
}

const char* nameOf(Side side) {
  constexpr std::array<const char*, 4> kNames{"upper", "lower", "left", "right"};
  return kNames[side];
}

Chart topChart(const FrontRecord& front, const Viewpoint& view) {
  Chart chart = viewChart(front, {front.model.origin.translation(), view.right, view.out});
  chart.title = view.words.top;
  chart.x_label = view.words.right;
  chart.y_label = view.words.out;
  chart.y_down = true;
  return chart;
}

Chart sideChart(const FrontRecord& front, const Viewpoint& view) {
  Chart chart = viewChart(front, {front.model.origin.translation(), view.out, view.up});
  chart.title = view.words.side;
  chart.x_label = view.words.out;
  chart.y_label = view.words.up;
  return chart;
}

}  // namespace cabinet_articulation
