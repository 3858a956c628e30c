// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/geometry/limits.h"

#include <sstream>
#include <stdexcept>
#include <string>

namespace cabinet_articulation::core {
namespace {

constexpr int kCovarianceElements = 36;

template <class Value>
[[noreturn]] void refuse(const char* element, const Value& value, const Limit& limit, const char* otherwise = "") {
  std::ostringstream text;
  text << element << " is " << value << ", expected " << limit.min << " to " << limit.max << " " << limit.unit << otherwise;
  throw std::invalid_argument(text.str());
}

}  // namespace

bool isWithin(double value, const Limit& limit) { return value >= limit.min && value <= limit.max; }

void requireWithin(const char* element, double value, const Limit& limit) {
  if (!isWithin(value, limit)) refuse(element, value, limit);
}

void requireSideOrUnknown(const char* element, double value) {
  if (value != 0 && !isWithin(value, limits::kSide)) refuse(element, value, limits::kSide, ", or 0: not known");
}

void requireWithin(const char* element, const Eigen::Vector3d& position, const Limit& limit) {
  for (int i = 0; i < position.size(); ++i) {
    if (isWithin(position[i], limit)) continue;
    std::ostringstream text;
    text << '(' << position.x() << ", " << position.y() << ", " << position.z() << ')';
    refuse(element, text.str(), limit);
  }
}

void requireCovariance(const char* element, const double* covariance, const Limit& limit) {
  for (int i = 0; i < kCovarianceElements; ++i) requireWithin(element, covariance[i], limit);
}

void requireAtMost(const char* entries, std::size_t count, std::size_t most) {
  if (count > most)
    throw std::invalid_argument("there are " + std::to_string(count) + " " + entries + ", expected " + std::to_string(most) +
                                " at most");
}

}  // namespace cabinet_articulation::core
