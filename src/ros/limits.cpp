// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/ros/limits.h"

#include <sstream>
#include <stdexcept>

namespace cabinet_articulation {
namespace {

constexpr int kCovarianceElements = 36;

[[noreturn]] void refuse(const char* element, double value, const Limit& limit, const char* otherwise) {
  std::ostringstream text;
  text << element << " is " << value << ", expected " << limit.min << " to " << limit.max << " " << limit.unit << otherwise;
  throw std::invalid_argument(text.str());
}

bool isWithin(double value, const Limit& limit) { return value >= limit.min && value <= limit.max; }

}  // namespace

void requireWithin(const char* element, double value, const Limit& limit) {
  if (!isWithin(value, limit)) refuse(element, value, limit, "");
}

void requireSideOrUnknown(const char* element, double value) {
  if (value != 0 && !isWithin(value, limits::kSide)) refuse(element, value, limits::kSide, ", or 0: not known");
}

void requireCovariance(const double* covariance, const char* element) {
  for (int i = 0; i < kCovarianceElements; ++i) requireWithin(element, covariance[i], limits::kVariance);
}

void requireStamp(const char* element, const ros::Time& stamp) {
  if (stamp.sec <= limits::kLastSecond) return;
  throw std::invalid_argument(std::string(element) + " is " + std::to_string(stamp.sec) + " s, expected " +
                              std::to_string(limits::kLastSecond) + " s at most: time of ROS ends soon after");
}

}  // namespace cabinet_articulation
