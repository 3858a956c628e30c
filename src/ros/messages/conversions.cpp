// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/conversions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "joints/front_names.h"
#include "ros/checks/from_messages.h"

namespace cabinet_articulation {
namespace {

void requireSane(const Rectangle& message) {
  core::requireWithin("width", message.width, core::limits::kSide);
  core::requireWithin("height", message.height, core::limits::kSide);
  core::requireCovariance("covariance", message.pose.covariance.data(), core::limits::kSensedVariance);
  core::requireWithin("precision", message.precision, core::limits::kQuality);
  core::requireWithin("recall", message.recall, core::limits::kQuality);
  for (const float support : message.edge_support) core::requireWithin("edge_support", support, core::limits::kShare);
  core::requireWithin("plane", message.plane, {0, std::numeric_limits<int>::max(), "(an index)"});
}

/// The closed position and what follows from it may be unknown, NaN; all else must be numbers.
void requireSane(const ArticulationModel& message) {
  const std::string unfit = message.name.empty() ? "" : core::whyUnfit(message.name);
  if (!unfit.empty()) throw std::invalid_argument(unfit);
  core::requireSideOrUnknown("width", message.width);
  core::requireSideOrUnknown("height", message.height);
  core::requireWithin("q", message.q, core::limits::kConfiguration);
  core::requireWithin("q_min", message.q_min, core::limits::kConfiguration);
  core::requireWithin("q_max", message.q_max, core::limits::kConfiguration);
  core::requireWithin("radius", message.radius, core::limits::kRadius);
  core::requireWithin("pitch", message.pitch, core::limits::kConfiguration);
  core::requireWithin("length of axis", fromMessage(message.axis).norm(),
                      {0, core::limits::kUnitLength.max, core::limits::kUnitLength.unit});
  core::requireWithin("axis_point", fromMessage(message.axis_point), core::limits::kFromOrigin);
  core::requireCovariance("covariance", message.covariance.data(), core::limits::kJointVariance);
  core::requireWithin("position_error", message.position_error, core::limits::kError);
  core::requireWithin("orientation_error", message.orientation_error, core::limits::kError);
  core::requireWithin("observations", message.observations, {0, std::numeric_limits<int>::max(), "(a number)"});
  core::requireWithin("support", message.support, {0, std::numeric_limits<int>::max(), "(a number)"});
  core::requireWithin("doubt", message.doubt, core::limits::kQuality);
  core::requireWithin("parent_probability", message.parent_probability, core::limits::kProbability);
  core::requireAtMost("probabilities", message.probabilities.size(), core::modelRegistry().size());
  for (const double probability : message.probabilities)
    core::requireWithin("probabilities", probability, core::limits::kProbability);
  core::requireAtMost("poses in curve", message.curve.size(), core::limits::kMostEntries);
  core::requireAtMost("params", message.params.size(), core::limits::kMostEntries);
}

}  // namespace

Rectangle toMessage(const core::DetectedRectangle& rectangle) {
  Rectangle message;
  message.pose.pose = toMessage(rectangle.rectangle.pose);
  message.pose.covariance = toMessage(rectangle.covariance);
  message.width = rectangle.rectangle.width;
  message.height = rectangle.rectangle.height;
  message.precision = rectangle.precision;
  message.recall = rectangle.recall;
  std::copy(rectangle.edge_support.begin(), rectangle.edge_support.end(), message.edge_support.begin());
  message.hollow = rectangle.hollow;
  message.plane = static_cast<std::uint32_t>(std::max(rectangle.region, 0));
  return message;
}

core::DetectedRectangle fromMessage(const Rectangle& message) {
  requireSane(message);
  core::DetectedRectangle rectangle;
  rectangle.rectangle = {fromMessage(message.pose.pose), message.width, message.height};
  core::requireWithin("position", rectangle.rectangle.center(), core::limits::kSensed);
  rectangle.covariance = fromMessage(message.pose.covariance);
  rectangle.precision = message.precision;
  rectangle.recall = message.recall;
  std::copy(message.edge_support.begin(), message.edge_support.end(), rectangle.edge_support.begin());
  rectangle.hollow = message.hollow;
  rectangle.region = static_cast<int>(message.plane);
  return rectangle;
}

RectangleArray toMessage(const std::vector<core::DetectedRectangle>& rectangles, const std_msgs::Header& header) {
  RectangleArray message;
  message.header = header;
  message.rectangles.reserve(rectangles.size());
  for (const core::DetectedRectangle& rectangle : rectangles) message.rectangles.push_back(toMessage(rectangle));
  return message;
}

std::vector<core::DetectedRectangle> fromMessage(const RectangleArray& message) {
  return fromMessages<core::DetectedRectangle>(message.rectangles, "rectangles", core::limits::kMostFronts);
}

ArticulationModel toMessage(const core::LearnedModel& model, const std::string& frame_id) {
  ArticulationModel message;
  message.header.stamp = toStamp(model.stamp);
  message.header.frame_id = frame_id;
  message.id = model.id;
  message.name = model.name;
  message.type = static_cast<std::uint8_t>(model.type);
  message.probabilities = model.probabilities;
  message.moved = model.moved;
  message.explained = model.explained;
  message.observed = model.observed;
  message.hollow = model.hollow;
  message.support = model.support;
  message.doubt = model.doubt;
  message.parent = model.parent;
  message.parent_probability = model.parent_probability;
  message.origin = toMessage(model.origin);
  message.axis = toVector(model.axis);
  message.axis_point = toPoint(model.axis_point);
  message.pitch = model.pitch;
  message.radius = model.radius;
  message.q = model.q;
  message.q_min = model.q_min;
  message.q_max = model.q_max;
  message.q_min_is_end = model.q_min_is_end;
  message.q_max_is_end = model.q_max_is_end;
  message.q_closed = model.q_closed;
  message.closed_known = model.closed_known;
  message.opening = model.opening;
  for (const Eigen::Isometry3d& pose : model.curve) message.curve.push_back(toMessage(pose));
  message.width = model.width;
  message.height = model.height;
  message.covariance = toMessage(model.covariance);
  message.position_error = model.position_error;
  message.orientation_error = model.orientation_error;
  message.observations = static_cast<std::uint32_t>(std::max(model.observations, 0));
  for (const core::ModelParam& param : model.params) {
    Param entry;
    entry.name = param.name;
    entry.value = param.value;
    entry.type = static_cast<std::uint8_t>(param.kind);
    message.params.push_back(entry);
  }
  return message;
}

geometry_msgs::PoseWithCovariance toMessage(const core::UncertainPose& pose) {
  geometry_msgs::PoseWithCovariance message;
  message.pose = toMessage(pose.pose);
  message.covariance = toMessage(pose.covariance);
  return message;
}

core::LearnedModel fromMessage(const ArticulationModel& message) {
  if (message.type >= core::modelRegistry().size())
    throw std::invalid_argument("type is " + std::to_string(message.type) + ", expected less than " +
                                std::to_string(core::modelRegistry().size()));
  requireSane(message);
  core::LearnedModel model;
  model.id = message.id;
  model.stamp = message.header.stamp.toSec();
  model.name = message.name;
  model.type = static_cast<core::JointType>(message.type);
  model.probabilities = message.probabilities;
  model.moved = message.moved;
  model.explained = message.explained;
  model.observed = message.observed;
  model.hollow = message.hollow;
  model.support = message.support;
  model.doubt = message.doubt;
  model.parent = message.parent;
  model.parent_probability = message.parent_probability;
  model.origin = fromMessage(message.origin);
  model.axis = fromMessage(message.axis);
  model.axis_point = fromMessage(message.axis_point);
  model.pitch = message.pitch;
  model.radius = message.radius;
  model.q = message.q;
  model.q_min = message.q_min;
  model.q_max = message.q_max;
  model.q_min_is_end = message.q_min_is_end;
  model.q_max_is_end = message.q_max_is_end;
  model.q_closed = message.q_closed;
  model.closed_known = message.closed_known;
  model.opening = message.opening;
  for (const geometry_msgs::Pose& pose : message.curve) model.curve.push_back(fromMessage(pose));
  model.width = message.width;
  model.height = message.height;
  model.covariance = fromMessage(message.covariance);
  model.position_error = message.position_error;
  model.orientation_error = message.orientation_error;
  model.observations = static_cast<int>(message.observations);
  for (const Param& param : message.params)
    model.params.push_back({param.name, param.value, static_cast<core::ModelParam::Kind>(param.type)});
  return model;
}

ArticulationModelArray toMessage(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header) {
  ArticulationModelArray message;
  message.header = header;
  message.models.reserve(models.size());
  for (const core::LearnedModel& model : models) message.models.push_back(toMessage(model, header.frame_id));
  return message;
}

std::vector<core::LearnedModel> fromMessage(const ArticulationModelArray& message) {
  return fromMessages<core::LearnedModel>(message.models, "models", core::limits::kMostFronts);
}

std::vector<core::LearnedModel> usableModels(const ArticulationModelArray& message, std::string* left_out) {
  const auto convert = [](const ArticulationModel& model) { return fromMessage(model); };
  return convertUsable<core::LearnedModel>(message.models, "models", core::limits::kMostFronts, convert, left_out);
}

}  // namespace cabinet_articulation
