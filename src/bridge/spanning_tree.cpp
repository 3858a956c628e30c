// SPDX-License-Identifier: BSD-3-Clause
#include "bridge/spanning_tree.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "bridge/original_learner.h"
#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation::bridge {
namespace {

using articulation_msgs::ArticulatedObjectMsg;
using articulation_msgs::ModelMsg;
using articulation_msgs::ParamMsg;

constexpr core::Limit kParts{2, 20, "parts"};  ///< ours: an object's; fits are limited by requireSoon()

struct Edge {
  std::size_t from = 0, to = 0;
  double bic = 0;
  ModelMsg model;
};

void requireSane(const ArticulatedObjectMsg& object) {
  core::requireWithin("number of parts", static_cast<double>(object.parts.size()), kParts);
  for (const auto& part : object.parts)
    if (part.pose.size() != object.parts.front().pose.size())
      throw std::invalid_argument("the parts have " + std::to_string(object.parts.front().pose.size()) + " and " +
                                  std::to_string(part.pose.size()) + " poses, expected as many of each");
  const std::size_t pairs = object.parts.size() * (object.parts.size() - 1) / 2;
  requireSoon(std::to_string(pairs) + " pairs of parts", pairs * object.parts.front().pose.size());
}

/// The way of part `to` as part `from` sees it, and its model.
Edge edgeOf(const ArticulatedObjectMsg& object, std::size_t from, std::size_t to, const core::ArticulationConfig& config) {
  Edge edge{from, to, 0, {}};
  const auto &a = object.parts[from].pose, &b = object.parts[to].pose;
  for (std::size_t i = 0; i < a.size(); ++i)
    edge.model.track.pose.push_back(toMessage(fromMessage(a[i]).inverse() * fromMessage(b[i])));
  edge.model.track.header = object.header;
  fitTo(config, &edge.model);
  edge.model.id = static_cast<std::int32_t>(from * object.parts.size() + to);
  edge.model.track.id = edge.model.id;
  edge.bic = requireParam(edge.model.params, "bic");
  return edge;
}

/// The joint of least BIC that leads from what is in the tree to what is not; Prim's algorithm.
Edge nextEdge(const std::vector<Edge>& edges, const std::set<std::size_t>& in_tree) {
  const Edge* best = nullptr;
  for (const Edge& edge : edges)
    if (in_tree.count(edge.from) != in_tree.count(edge.to) && (!best || edge.bic < best->bic)) best = &edge;
  return *best;
}

/// The parts at both ends, from the end that is known.
void project(const Edge& edge, bool from_is_known, ArticulatedObjectMsg* object) {
  const auto& known = object->parts[from_is_known ? edge.from : edge.to].pose_projected;
  auto& next = object->parts[from_is_known ? edge.to : edge.from].pose_projected;
  next.clear();
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Eigen::Isometry3d between = fromMessage(edge.model.track.pose_projected[i]);
    next.push_back(toMessage(fromMessage(known[i]) * (from_is_known ? between : between.inverse())));
  }
}

}  // namespace

ArticulatedObjectMsg spanningTree(ArticulatedObjectMsg object, const core::ArticulationConfig& base) {
  requireSane(object);
  const core::ArticulationConfig config = configured(base, object.params);
  std::vector<Edge> edges;
  for (std::size_t from = 0; from < object.parts.size(); ++from)
    for (std::size_t to = from + 1; to < object.parts.size(); ++to) edges.push_back(edgeOf(object, from, to, config));
  object.models.clear();
  object.parts.front().pose_projected = object.parts.front().pose;
  std::set<std::size_t> in_tree{0};
  double bic = 0, degrees = 0;
  while (in_tree.size() < object.parts.size()) {
    const Edge edge = nextEdge(edges, in_tree);
    project(edge, in_tree.count(edge.from) > 0, &object);
    in_tree.insert({edge.from, edge.to});
    object.models.push_back(edge.model);
    bic += edge.bic;
    degrees += requireParam(edge.model.params, "dofs");
  }
  setParam("object_parts", static_cast<double>(object.parts.size()), ParamMsg::EVAL, &object.params);
  setParam("object_samples", static_cast<double>(object.parts.front().pose.size()), ParamMsg::EVAL, &object.params);
  setParam("spanningtree.dof", degrees, ParamMsg::EVAL, &object.params);
  setParam("bic_spanningtree", bic, ParamMsg::EVAL, &object.params);
  return object;
}

}  // namespace cabinet_articulation::bridge
