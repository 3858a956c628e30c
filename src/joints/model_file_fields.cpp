// SPDX-License-Identifier: BSD-3-Clause
#include "joints/model_file_fields.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "articulation/models/model_registry.h"
#include "cabinet_articulation/geometry/limits.h"
#include "joints/front_names.h"
#include "joints/yaml_fields.h"

namespace cabinet_articulation::core {
namespace {

using namespace yaml;  // NOLINT(google-build-using-namespace): this file alone is made of them

constexpr std::size_t kEdges = 4;
constexpr std::size_t kObservation = 1 + kPose + 2 + kEdges + kTriangle;
constexpr double kObservationsOfOlderFiles = 10;

double stampToWrite(double stamp) { return std::isfinite(stamp) ? std::clamp<double>(stamp, 0, limits::kLastSecond) : 0; }

/// What ros::Time holds; a robot's messages know no others.
double checkedStamp(double value, const std::string& field) {
  if (value < 0 || value > limits::kLastSecond)
    throw std::runtime_error("'" + field + "' has the time " + toText(value) + ", expected seconds from 0 to " +
                             std::to_string(limits::kLastSecond));
  return value;
}

/// What older files have among the params, where nobody would keep it up to date.
bool isField(const std::string& param) { return param == "support" || param == "doubt"; }

/// Older files have none.
std::string nameFromYaml(const YAML::Node& node, std::uint32_t id) {
  if (!node) return "";
  if (!node.IsScalar()) throw std::runtime_error("'name' is no name");
  const std::string name = node.Scalar(), unfit = whyUnfit(name);
  if (!unfit.empty()) throw std::runtime_error("'name': " + unfit);
  if (ownerOfDefaultName(name).value_or(id) != id) throw std::runtime_error("'name' is that of another front, " + name);
  return name;
}

JointType typeFromName(const YAML::Node& node) {
  for (const ModelEntry& entry : modelRegistry())
    if (node && node.IsScalar() && node.Scalar() == entry.name) return entry.type;
  throw std::runtime_error("'type' is no kind of joint");
}

/// In the order of their stamps, which tracks of other programs need not have.
std::vector<TrackedObservation> inOrder(const Track& track) {
  std::vector<TrackedObservation> observations = track.observations;
  std::stable_sort(observations.begin(), observations.end(), [](const TrackedObservation& a, const TrackedObservation& b) {
    return stampToWrite(a.stamp) < stampToWrite(b.stamp);
  });
  return observations;
}

YAML::Node observationsToYaml(const Track& track) {
  YAML::Node node;
  for (const TrackedObservation& observation : inOrder(track)) {
    if (!observation.rectangle.pose.matrix().allFinite()) continue;  // the learner ignores it, and a reader would refuse it
    Numbers n{stampToWrite(observation.stamp)};
    append(observation.rectangle.pose, &n);
    n.insert(n.end(), {observation.rectangle.width, observation.rectangle.height});
    n.insert(n.end(), observation.edge_support.begin(), observation.edge_support.end());
    append(observation.covariance.allFinite() ? observation.covariance : Matrix6d(Matrix6d::Zero()), &n);
    node.push_back(list(n));
  }
  return node;
}

TrackedObservation observationFromYaml(const YAML::Node& node) {
  const Numbers n = numbers(node, "observations", kObservation);
  TrackedObservation observation;
  observation.stamp = checkedStamp(n[0], "observations");
  observation.rectangle = {pose(&n[1], "observations"), n[8], n[9]};
  requireSideOrUnknown("an observation's width", n[8]);
  requireSideOrUnknown("an observation's height", n[9]);
  for (std::size_t i = 0; i < kEdges; ++i) {
    requireWithin("an observation's share of an edge", n[10 + i], limits::kShare);
    observation.edge_support[i] = static_cast<float>(n[10 + i]);
  }
  for (std::size_t i = 10 + kEdges; i < kObservation; ++i) requireWithin("an observation's covariance", n[i], limits::kVariance);
  observation.covariance = covariance(&n[10 + kEdges]);
  observation.measured = observation.rectangle;
  observation.measured_covariance = observation.covariance;
  return observation;
}

void readJoint(const YAML::Node& node, LearnedModel* model) {
  model->type = typeFromName(node["type"]);
  // Types that are younger than a file have no probability in it.
  const std::size_t types = modelRegistry().size(), least = static_cast<std::size_t>(model->type) + 1;
  const YAML::Node written = node["probabilities"];
  const std::size_t size = written && written.IsSequence() ? std::clamp(written.size(), least, types) : types;
  model->probabilities = numbers(written, "probabilities", size);
  for (const double probability : model->probabilities) requireWithin("probabilities", probability, limits::kProbability);
  model->probabilities.resize(types, 0);
  model->origin = pose(numbers(node["origin"], "origin", kPose).data(), "origin");
  model->axis = unitVector(node["axis"], "axis");
  const Numbers point = numbers(node["axis_point"], "axis_point", 3);
  model->axis_point = Eigen::Vector3d(point[0], point[1], point[2]);
  requireWithin("axis_point", model->axis_point, limits::kFromOrigin);
  if (node["curve"]) requireAtMost("poses in 'curve'", node["curve"].size(), limits::kMostEntries);
  for (const YAML::Node& entry : node["curve"]) model->curve.push_back(pose(numbers(entry, "curve", kPose).data(), "curve"));
  model->radius = within(node["radius"], "radius", limits::kRadius);
  if (node["pitch"]) model->pitch = within(node["pitch"], "pitch", limits::kConfiguration);  // older files have none
  model->covariance = covariance(numbers(node["covariance"], "covariance", kTriangle).data());
}

/// Those of the world do without, as older files.
void readParent(const YAML::Node& node, LearnedModel* model) {
  if (!node["parent"]) return;
  model->parent = count(node["parent"], "parent", kLargestId);
  if (node["parent_probability"])
    model->parent_probability = within(node["parent_probability"], "parent_probability", limits::kProbability);
}

void readRange(const YAML::Node& node, LearnedModel* model) {
  model->q = within(node["q"], "q", limits::kConfiguration);
  model->q_min = within(node["q_min"], "q_min", limits::kConfiguration);
  model->q_max = within(node["q_max"], "q_max", limits::kConfiguration);
  if (model->q_min > model->q_max) throw std::runtime_error("'q_min' is more than 'q_max'");
  model->q_min_is_end = flag(node["q_min_is_end"], "q_min_is_end");
  model->q_max_is_end = flag(node["q_max_is_end"], "q_max_is_end");
  // Of fronts that were not seen closed, and in older files, it is not there.
  model->closed_known = static_cast<bool>(node["q_closed"]);
  if (model->closed_known) model->q_closed = within(node["q_closed"], "q_closed", limits::kConfiguration);
  model->opening = openingAt(*model, model->q);
}

void readQuality(const YAML::Node& node, LearnedModel* model) {
  // An older file tells no support, but was written of what had been seen often.
  model->support = node["support"] ? count(node["support"], "support", kLargestId) : kObservationsOfOlderFiles;
  if (node["doubt"]) model->doubt = within(node["doubt"], "doubt", limits::kShare);
  model->position_error = within(node["position_error"], "position_error", limits::kError);
  model->orientation_error = within(node["orientation_error"], "orientation_error", limits::kError);
  constexpr int kMost = std::numeric_limits<int>::max();
  model->observations = static_cast<int>(count(node["number_of_observations"], "number_of_observations", kMost));
  for (const auto& entry : node["params"]) {
    if (isField(entry.first.Scalar())) continue;
    const Numbers param = numbers(entry.second, "params", 2);
    requireWithin("a param's kind", param[1], {ModelParam::kPrior, ModelParam::kEval, "(Param.msg names them)"});
    model->params.push_back({entry.first.Scalar(), param[0], static_cast<ModelParam::Kind>(param[1])});
  }
}

std::vector<TrackedObservation> readObservations(const YAML::Node& node) {
  std::vector<TrackedObservation> observations;
  for (const YAML::Node& entry : node) observations.push_back(observationFromYaml(entry));
  if (observations.empty()) throw std::runtime_error("'observations' is missing or empty");
  const auto earlier = [](const TrackedObservation& a, const TrackedObservation& b) { return a.stamp < b.stamp; };
  if (!std::is_sorted(observations.begin(), observations.end(), earlier))
    throw std::runtime_error("'observations' are not in the order of their times");
  return observations;
}

}  // namespace

YAML::Node toYaml(const KnownFront& front) {
  const LearnedModel& model = front.model;
  YAML::Node node;
  node["id"] = model.id;
  if (!model.name.empty()) node["name"] = model.name;
  if (model.parent != 0) {
    node["parent"] = model.parent;
    node["parent_probability"] = toText(model.parent_probability);
  }
  node["type"] = modelName(model.type);
  node["stamp"] = toText(stampToWrite(model.stamp));
  node["support"] = toText(model.support);
  node["doubt"] = toText(std::clamp(model.doubt, 0.0, 1.0));
  node["probabilities"] = list(model.probabilities);
  node["origin"] = list(model.origin);
  node["axis"] = list(model.axis);
  node["axis_point"] = list(model.axis_point);
  for (const Eigen::Isometry3d& pose : model.curve) node["curve"].push_back(list(pose));
  const std::pair<const char*, double> scalars[] = {{"radius", model.radius},
                                                    {"pitch", model.pitch},
                                                    {"q", model.q},
                                                    {"q_min", model.q_min},
                                                    {"q_max", model.q_max},
                                                    {"width", model.width},
                                                    {"height", model.height},
                                                    {"position_error", model.position_error},
                                                    {"orientation_error", model.orientation_error}};
  for (const auto& [name, value] : scalars) node[name] = toText(value);
  node["q_min_is_end"] = model.q_min_is_end;
  node["q_max_is_end"] = model.q_max_is_end;
  if (model.hollow) node["hollow"] = true;
  if (model.closed_known) node["q_closed"] = toText(model.q_closed);
  node["covariance"] = list(model.covariance);
  node["number_of_observations"] = model.observations;
  for (const ModelParam& param : model.params) node["params"][param.name] = list(Numbers{param.value, double(param.kind)});
  node["observations"] = observationsToYaml(front.track);
  return node;
}

KnownFront frontFromYaml(const YAML::Node& node) {
  if (!node.IsMap()) throw std::runtime_error("expected a group of fields");
  KnownFront front;
  LearnedModel& model = front.model;
  model.id = count(node["id"], "id", kLargestId);
  model.name = nameFromYaml(node["name"], model.id);
  model.moved = model.explained = true;
  model.stamp = checkedStamp(number(node["stamp"], "stamp"), "stamp");
  readParent(node, &model);
  readJoint(node, &model);
  readRange(node, &model);
  model.width = side(node["width"], "width");
  model.height = side(node["height"], "height");
  model.hollow = node["hollow"] && flag(node["hollow"], "hollow");
  readQuality(node, &model);
  front.track.id = model.id;
  front.track.width = model.width;
  front.track.height = model.height;
  front.track.hollow = model.hollow;
  front.track.observations = readObservations(node["observations"]);
  return front;
}

}  // namespace cabinet_articulation::core
