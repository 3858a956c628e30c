// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <string>
#include <vector>

#include "cabinet_articulation/geometry/limits.h"
#include "cabinet_articulation/rectangles/detected_rectangle.h"

/// Fields of a model file. All that read throw std::runtime_error or std::invalid_argument with the field's name.
namespace cabinet_articulation::core::yaml {

using Numbers = std::vector<double>;

constexpr std::size_t kPose = 7;       ///< numbers of a pose: position, quaternion x y z w
constexpr std::size_t kTriangle = 21;  ///< numbers of a covariance: the upper half, row by row

/// Twelve digits: less than a nanometre, and to the millisecond in a stamp of today.
std::string toText(double value);

YAML::Node list(const Numbers& numbers);
void append(const Eigen::Vector3d& v, Numbers* numbers);
void append(const Eigen::Isometry3d& pose, Numbers* numbers);
void append(const Matrix6d& covariance, Numbers* numbers);

template <class Value>
YAML::Node list(const Value& value) {
  Numbers numbers;
  append(value, &numbers);
  return list(numbers);
}

double number(const YAML::Node& node, const std::string& field);
std::uint32_t count(const YAML::Node& node, const std::string& field, std::uint32_t largest);
/// False where it is missing: a file may be older than the field.
bool flag(const YAML::Node& node, const std::string& field);
Numbers numbers(const YAML::Node& node, const std::string& field, std::size_t size);
Eigen::Vector3d unitVector(const YAML::Node& node, const std::string& field);
/// From kPose numbers.
Eigen::Isometry3d pose(const double* n, const std::string& field);
/// From kTriangle numbers.
Matrix6d covariance(const double* n);
double within(const YAML::Node& node, const char* field, const Limit& limit);
/// [m] 0: unknown.
double side(const YAML::Node& node, const char* field);

}  // namespace cabinet_articulation::core::yaml
