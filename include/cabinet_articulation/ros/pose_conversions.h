// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Vector3.h>
#include <ros/time.h>

#include <Eigen/Geometry>
#include <boost/array.hpp>

#include "cabinet_articulation/rectangles/detected_rectangle.h"

namespace cabinet_articulation {

geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose);
geometry_msgs::Point toPoint(const Eigen::Vector3d& p);
geometry_msgs::Vector3 toVector(const Eigen::Vector3d& v);
boost::array<double, 36> toMessage(const core::Matrix6d& covariance);

/// Throws std::invalid_argument for a position beyond limits::kFromOrigin, and for a quaternion that is not of unit length.
/// Allowed is 1 +- 0.01, as in RViz; it is normalised.
Eigen::Isometry3d fromMessage(const geometry_msgs::Pose& pose);
Eigen::Vector3d fromMessage(const geometry_msgs::Point& p);
Eigen::Vector3d fromMessage(const geometry_msgs::Vector3& v);
core::Matrix6d fromMessage(const boost::array<double, 36>& covariance);

/// Seconds of the core to a stamp, rounded to nanoseconds. Today's times keep 0.2 microseconds in a double: compare
/// stamps that went through the core with a tolerance, and take a frame's own stamp from its header. Never throws: what a
/// stamp cannot hold becomes its first or last one.
ros::Time toStamp(double seconds);

/// Throws std::invalid_argument for a stamp beyond limits::kLastSecond.
void requireStamp(const char* element, const ros::Time& stamp);

/// [s], to the nanosecond, also where it is more than ros::Duration holds (68 years).
double secondsBetween(const ros::Time& earlier, const ros::Time& later);

}  // namespace cabinet_articulation
