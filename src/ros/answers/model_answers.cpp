// SPDX-License-Identifier: BSD-3-Clause
#include "ros/answers/model_answers.h"

#include <algorithm>
#include <string>
#include <vector>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/joints/evaluation.h"
#include "cabinet_articulation/ros/conversions.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "ros/checks/from_messages.h"

namespace cabinet_articulation {
namespace {

/// An error names the part of the request that it is about.
template <class Convert>
auto fromPart(const char* part, const Convert& convert) {
  try {
    return convert();
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(part) + ": " + error.what());
  }
}

/// Poses of a front that hangs on another one are in the frame of that, whatever the header says.
core::LearnedModel modelOf(const ArticulationModel& message) {
  if (message.parent != 0)
    throw std::invalid_argument("model: parent is " + std::to_string(message.parent) +
                                ", expected 0: its poses are in the frame of that front, and nobody says here where that is; "
                                "transform them and set parent to 0");
  return fromPart("model", [&] { return fromMessage(message); });
}

/// Poses of different frames cannot be compared. Who names none means the other's.
void requireOneFrame(const std::string& model, const std::string& track) {
  if (model != track && !model.empty() && !track.empty())
    throw std::invalid_argument("the model is in the frame '" + model + "' and the track in '" + track + "'");
}

template <class Response>
void append(const core::NearestConfiguration& nearest, const Eigen::Isometry3d& projected, Response* response) {
  response->q.push_back(nearest.q);
  response->projected.push_back(toMessage(projected));
  response->position_residuals.push_back(nearest.position_residual);
  response->orientation_residuals.push_back(nearest.orientation_residual);
}

std::string warnOfRange(const core::LearnedModel& model, const std::vector<double>& q) {
  const auto [lowest, highest] = std::minmax_element(q.begin(), q.end());
  return core::outsideSeenRange(model, *lowest, *highest);
}

}  // namespace

EvaluateModel::Response evaluateModel(const EvaluateModel::Request& request, const core::ArticulationConfig& config) {
  requireOneFrame(request.model.header.frame_id, request.track.header.frame_id);
  const core::LearnedModel model = modelOf(request.model);
  const core::Track track = fromPart("track", [&] { return wholeTrack(request.track); });
  const core::TrackEvaluation evaluation = core::evaluateOnTrack(model, track, config);
  EvaluateModel::Response response;
  for (std::size_t i = 0; i < evaluation.nearest.size(); ++i) append(evaluation.nearest[i], evaluation.projected[i], &response);
  response.position_error = evaluation.position_error;
  response.orientation_error = evaluation.orientation_error;
  response.outlier_ratio = evaluation.outlier_ratio;
  response.log_likelihood = evaluation.log_likelihood;
  return response;
}

ProjectPoses::Response projectPoses(const ProjectPoses::Request& request) {
  const core::LearnedModel model = core::takenAsJoint(modelOf(request.model));
  if (request.poses.empty()) throw std::invalid_argument("poses is empty, expected those to project");
  const auto poses = fromMessages<Eigen::Isometry3d>(request.poses, "poses", core::limits::kMostEntries);
  ProjectPoses::Response response;
  for (const Eigen::Isometry3d& pose : poses) {
    const core::NearestConfiguration nearest = core::findConfiguration(model, pose);
    append(nearest, model.predict(nearest.q), &response);
    response.openings.push_back(core::openingAt(model, nearest.q));
  }
  response.message = warnOfRange(model, response.q);
  return response;
}

ProjectConfigurations::Response projectConfigurations(const ProjectConfigurations::Request& request) {
  const core::LearnedModel model = core::takenAsJoint(modelOf(request.model));
  if (request.q.empty()) throw std::invalid_argument("q is empty, expected the openings to project");
  core::requireAtMost("openings in q", request.q.size(), core::limits::kMostEntries);
  ProjectConfigurations::Response response;
  std::vector<double> openings;
  for (const double q : request.q) {
    openings.push_back(request.as_opening ? core::configurationAtOpening(model, q) : q);
    response.poses.push_back(toMessage(core::predictWithCovariance(model, openings.back())));
  }
  response.header = request.model.header;
  response.message = warnOfRange(model, openings);
  return response;
}

}  // namespace cabinet_articulation
