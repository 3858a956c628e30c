// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/joint.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <utility>

#include "articulation/models/model_registry.h"
#include "geometry/cross_matrix.h"
#include "joints/front_names.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kRangeMargin = 0.01;  ///< [m or rad] beyond the range is still within its noise

std::string inWords(const LearnedModel& model) { return "front " + std::to_string(model.id); }

}  // namespace

bool isJoint(const LearnedModel& model) { return wasJoint(model) && !isGivenUp(model); }

bool isGivenUp(const LearnedModel& model) { return model.doubt >= 1; }

bool wasJoint(const LearnedModel& model) { return model.moved && model.explained && modelEntry(model.type).moves; }

std::string nameOf(const LearnedModel& model) { return model.name.empty() ? defaultName(model.id) : model.name; }

double typeProbability(const LearnedModel& model) {
  const auto index = static_cast<std::size_t>(model.type);
  return index < model.probabilities.size() ? model.probabilities[index] : 0;
}

void requireJoint(const LearnedModel& model) {
  if (wasJoint(model) && isGivenUp(model))
    throw ModelError(inWords(model) + " was taken for a " + modelName(model.type) +
                     " joint, but as many observations speak against that as for it; it is none until it is seen to move again");
  if (!model.moved)
    throw ModelError(inWords(model) + " has not moved enough yet to tell how it moves (" + std::to_string(model.observations) +
                     " observations)");
  if (!isJoint(model)) throw ModelError(inWords(model) + " moved, but no joint type describes how");
}

Eigen::Isometry3d jointBase(const LearnedModel& model) {
  const bool turns = modelEntry(model.type).turns;
  const Eigen::Vector3d z = model.axis.normalized();
  // x towards the front (where it turns) or along its width, as far as that is perpendicular to the axis.
  Eigen::Vector3d x = model.origin.linear().col(0);
  if (turns) x = model.origin.translation() - model.axis_point;
  x -= z * z.dot(x);
  if (x.norm() < 1e-6) x = z.unitOrthogonal();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear().col(0) = x.normalized();
  T.linear().col(1) = z.cross(x.normalized());
  T.linear().col(2) = z;
  T.translation() = turns ? model.axis_point : Eigen::Vector3d(model.origin.translation());
  return T;
}

Rectangle frontAt(const LearnedModel& model, double q) { return {model.predict(q), model.width, model.height}; }

double openEnd(const LearnedModel& model, double q_closed) {
  return model.q_max - q_closed > q_closed - model.q_min ? model.q_max : model.q_min;
}

double openingAt(const LearnedModel& model, double q) {
  if (!model.closed_known) return std::numeric_limits<double>::quiet_NaN();
  return std::clamp((q - model.q_closed) / (openEnd(model, model.q_closed) - model.q_closed), 0.0, 1.0);
}

void requireClosed(const LearnedModel& model) {
  requireJoint(model);
  if (!model.closed_known)
    throw ModelError("it is not known where " + inWords(model) + " is closed, for it was not seen closed; ask in q");
}

double configurationAtOpening(const LearnedModel& model, double opening) {
  requireClosed(model);
  return model.q_closed + opening * (openEnd(model, model.q_closed) - model.q_closed);
}

LearnedModel countedFromClosed(const LearnedModel& model) {
  LearnedModel counted = model;
  const bool grows = openEnd(model, model.q_closed) == model.q_max;
  counted.origin = model.predict(model.q_closed);
  if (!modelEntry(model.type).turns) {
    // That of the origin, which moved along an uncertain axis.
    Matrix6d J = Matrix6d::Identity();
    J.topRightCorner<3, 3>() = -model.q_closed * crossMatrix(model.axis);
    counted.covariance = J * model.covariance * J.transpose();
  }
  counted.q_closed = 0;
  for (double* q : {&counted.q, &counted.q_min, &counted.q_max}) *q = grows ? *q - model.q_closed : model.q_closed - *q;
  if (grows) return counted;
  counted.axis = -model.axis;
  std::swap(counted.q_min, counted.q_max);
  std::swap(counted.q_min_is_end, counted.q_max_is_end);
  return counted;
}

std::vector<LearnedModel> allCountedFromClosed(const std::vector<LearnedModel>& models) {
  std::vector<LearnedModel> counted;
  for (const LearnedModel& model : models)
    if (isJoint(model) && model.closed_known) counted.push_back(countedFromClosed(model));
  return counted;
}

std::string outsideSeenRange(const LearnedModel& model, double q_lowest, double q_highest) {
  if (q_lowest >= model.q_min - kRangeMargin && q_highest <= model.q_max + kRangeMargin) return "";
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << inWords(model) << " was seen from q = " << model.q_min << " to " << model.q_max
       << (modelEntry(model.type).unit == ConfigurationUnit::kRadian ? " rad" : " m") << "; beyond that this is a guess";
  return text.str();
}

}  // namespace cabinet_articulation::core
