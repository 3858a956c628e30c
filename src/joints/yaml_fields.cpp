// SPDX-License-Identifier: BSD-3-Clause
#include "joints/yaml_fields.h"

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "cabinet_articulation/geometry/limits.h"

namespace cabinet_articulation::core::yaml {
namespace {

constexpr double kUnitTolerance = 1e-6;

}  // namespace

std::string toText(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), std::abs(value) > 1e6 ? "%.6f" : "%.12g", value);
  return text;
}

YAML::Node list(const Numbers& numbers) {
  YAML::Node node;
  node.SetStyle(YAML::EmitterStyle::Flow);
  for (const double number : numbers) node.push_back(toText(number));
  return node;
}

void append(const Eigen::Vector3d& v, Numbers* numbers) { numbers->insert(numbers->end(), v.data(), v.data() + 3); }

void append(const Eigen::Isometry3d& pose, Numbers* numbers) {
  append(Eigen::Vector3d(pose.translation()), numbers);
  const Eigen::Quaterniond q = Eigen::Quaterniond(pose.linear()).normalized();
  numbers->insert(numbers->end(), q.coeffs().data(), q.coeffs().data() + 4);
}

void append(const Matrix6d& covariance, Numbers* numbers) {
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) numbers->push_back(covariance(i, j));
}

double number(const YAML::Node& node, const std::string& field) {
  double value = 0;
  if (!node || !node.IsScalar() || !YAML::convert<double>::decode(node, value) || !std::isfinite(value))
    throw std::runtime_error("'" + field + "' is missing or no finite number");
  return value;
}

std::uint32_t count(const YAML::Node& node, const std::string& field, std::uint32_t largest) {
  const double value = number(node, field);
  if (value < 0 || value > largest || value != std::floor(value))
    throw std::runtime_error("'" + field + "' is not a whole number from 0 to " + std::to_string(largest));
  return static_cast<std::uint32_t>(value);
}

bool flag(const YAML::Node& node, const std::string& field) {
  bool value = false;
  if (node && !YAML::convert<bool>::decode(node, value)) throw std::runtime_error("'" + field + "' is neither true nor false");
  return value;
}

Numbers numbers(const YAML::Node& node, const std::string& field, std::size_t size) {
  if (!node || !node.IsSequence() || node.size() != size)
    throw std::runtime_error("'" + field + "' is not a list of " + std::to_string(size) + " numbers");
  Numbers result;
  for (const YAML::Node& element : node) result.push_back(number(element, field));
  return result;
}

Eigen::Vector3d unitVector(const YAML::Node& node, const std::string& field) {
  const Numbers n = numbers(node, field, 3);
  const Eigen::Vector3d v(n[0], n[1], n[2]);
  if (std::abs(v.norm() - 1) > kUnitTolerance) throw std::runtime_error("'" + field + "' is not of unit length");
  return v.normalized();
}

Eigen::Isometry3d pose(const double* n, const std::string& field) {
  const Eigen::Quaterniond q(n[6], n[3], n[4], n[5]);
  if (std::abs(q.norm() - 1) > kUnitTolerance) throw std::runtime_error("'" + field + "' has no unit quaternion");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = q.normalized().toRotationMatrix();
  pose.translation() = Eigen::Vector3d(n[0], n[1], n[2]);
  requireWithin(field.c_str(), pose.translation(), limits::kFromOrigin);
  return pose;
}

Matrix6d covariance(const double* n) {
  Matrix6d covariance;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) covariance(i, j) = covariance(j, i) = *n++;
  return covariance;
}

double within(const YAML::Node& node, const char* field, const Limit& limit) {
  const double value = number(node, field);
  requireWithin(field, value, limit);
  return value;
}

double side(const YAML::Node& node, const char* field) {
  const double value = number(node, field);
  requireSideOrUnknown(field, value);
  return value;
}

}  // namespace cabinet_articulation::core::yaml
