// SPDX-License-Identifier: BSD-3-Clause
#include "joints/kind_fields.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "articulation/models/model_registry.h"
#include "joints/yaml_fields.h"

namespace cabinet_articulation::core {
namespace {

using namespace yaml;  // NOLINT(google-build-using-namespace): this file alone is made of them

constexpr std::size_t kQuaternion = 4;

JointShape shapeFromYaml(const YAML::Node& node) {
  if (!node.IsMap()) throw std::runtime_error("expected a group of fields");
  JointShape shape;
  const std::string type = node["type"] && node["type"].IsScalar() ? node["type"].Scalar() : "missing";
  if (type == modelName(JointType::kRotational))
    shape.type = JointType::kRotational;
  else if (type != modelName(JointType::kPrismatic))
    throw std::runtime_error("'type' is " + type + ", expected prismatic or rotational");
  const Numbers n = numbers(node["frame"], "frame", kQuaternion);
  const double of_pose[kPose] = {0, 0, 0, n[0], n[1], n[2], n[3]};
  shape.frame = pose(of_pose, "frame").linear();
  if (shape.turns()) shape.radius = within(node["radius"], "radius", limits::kRadius);
  if (shape.turns() && shape.radius == 0) throw std::runtime_error("'radius' is 0");
  shape.width = side(node["width"], "width");
  shape.height = side(node["height"], "height");
  shape.range = within(node["range"], "range", limits::kConfiguration);
  if (shape.range < 0) throw std::runtime_error("'range' is less than 0");
  return shape;
}

}  // namespace

YAML::Node toYaml(const JointShape& shape) {
  YAML::Node node;
  node["type"] = modelName(shape.type);
  const Eigen::Quaterniond q(shape.frame);
  node["frame"] = list(Numbers{q.x(), q.y(), q.z(), q.w()});
  if (shape.turns()) node["radius"] = toText(shape.radius);
  node["width"] = toText(shape.width);
  node["height"] = toText(shape.height);
  node["range"] = toText(shape.range);
  return node;
}

std::vector<JointShape> shapesFromYaml(const YAML::Node& node) {
  std::vector<JointShape> shapes;
  if (!node) return shapes;
  if (!node.IsSequence()) throw std::runtime_error("'kinds' is no list");
  requireAtMost("joints in 'kinds'", node.size(), kMostShapes);
  for (std::size_t i = 0; i < node.size(); ++i) {
    try {
      shapes.push_back(shapeFromYaml(node[i]));
    } catch (const std::exception& error) {
      throw std::runtime_error("joint " + std::to_string(i + 1) + " of 'kinds': " + error.what());
    }
  }
  return shapes;
}

std::vector<JointShape> united(std::vector<JointShape> shapes, const std::vector<JointShape>& others) {
  for (const JointShape& other : others)
    if (shapes.size() < kMostShapes &&
        std::none_of(shapes.begin(), shapes.end(), [&](const JointShape& shape) { return isSame(shape, other); }))
      shapes.push_back(other);
  return shapes;
}

}  // namespace cabinet_articulation::core
