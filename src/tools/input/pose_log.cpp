// SPDX-License-Identifier: BSD-3-Clause
#include "tools/input/pose_log.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <vector>

#include "cabinet_articulation/geometry/limits.h"
#include "config/ordinary_file.h"
#include "geometry/median.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kUnitTolerance = 0.05;
constexpr double kShortestMean = 0.5;             ///< of unit quaternions that are 120 degrees apart
constexpr std::size_t kLargestLog = 256U << 20U;  // [bytes] two days at 15 Hz with 100 characters a pose

/// Where an error is, for its message.
struct Location {
  const std::string& name;
  int line;

  [[noreturn]] void fail(const std::string& what) const { throw PoseLogError(name + ":" + std::to_string(line) + ": " + what); }
};

std::vector<double> parseNumbers(const std::string& text, const Location& location) {
  std::vector<double> numbers;
  const char* cursor = text.c_str();
  while (true) {
    cursor += std::strspn(cursor, " \t\r");
    if (*cursor == '\0') return numbers;
    const std::size_t length = std::strcspn(cursor, " \t\r");
    const std::string word(cursor, length);
    char* end = nullptr;
    const double number = std::strtod(word.c_str(), &end);
    if (*end != '\0') location.fail("'" + word + "' is not a number");
    if (!std::isfinite(number)) location.fail("'" + word + "' is not finite");
    numbers.push_back(number);
    cursor += length;
  }
}

/// What is shorter than a unit quaternion is the mean of some.
class NormalisedQuaternions {
 public:
  Eigen::Quaterniond normalised(const Eigen::Quaterniond& q, const Location& location) {
    const double length = q.norm();
    if (length > 1 + kUnitTolerance || length < kShortestMean)
      location.fail("the quaternion qx qy qz qw has length " + std::to_string(length) + ", expected 1");
    if (length < 1 - kUnitTolerance) ++count_;
    if (length >= shortest_) return q.normalized();
    shortest_ = length;
    line_ = location.line;
    return q.normalized();
  }

  std::string warning() const {
    if (count_ == 0) return "";
    return std::to_string(count_) +
           " quaternions are not of length 1, as means of some are not, and were normalised; the shortest, in line " +
           std::to_string(line_) + ", has length " + std::to_string(shortest_);
  }

 private:
  int count_ = 0, line_ = 0;
  double shortest_ = 1;
};

Rectangle parseRectangle(const std::vector<double>& numbers, const Location& location, NormalisedQuaternions* quaternions) {
  Rectangle rectangle;
  rectangle.pose.translation() << numbers[0], numbers[1], numbers[2];
  if (numbers.size() < 7) return rectangle;
  const Eigen::Quaterniond q(numbers[6], numbers[3], numbers[4], numbers[5]);
  rectangle.pose.linear() = quaternions->normalised(q, location).toRotationMatrix();
  if (numbers.size() < 9) return rectangle;
  rectangle.width = numbers[7];
  rectangle.height = numbers[8];
  if (rectangle.width <= 0 || rectangle.height <= 0) location.fail("width and height must be positive");
  rectangle.pose.translate(Eigen::Vector3d(rectangle.width / 2, rectangle.height / 2, 0));
  return rectangle;
}

void requireSane(const Rectangle& rectangle, const Location& location) {
  try {
    requireSideOrUnknown("width", rectangle.width);
    requireSideOrUnknown("height", rectangle.height);
    requireWithin("position", rectangle.pose.translation(), limits::kFromOrigin);
  } catch (const std::invalid_argument& error) {
    location.fail(error.what());
  }
}

void estimateSize(Track* track) {
  std::vector<double> widths, heights;
  for (const TrackedObservation& observation : track->observations) {
    widths.push_back(observation.rectangle.width);
    heights.push_back(observation.rectangle.height);
  }
  track->width = median(widths);
  track->height = median(heights);
}

}  // namespace

PoseLog readPoseLog(std::istream& in, const std::string& name) {
  PoseLog log;
  NormalisedQuaternions quaternions;
  std::string text;
  for (Location location{name, 1}; std::getline(in, text); ++location.line) {
    const std::size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos || text[first] == '#') continue;
    const std::vector<double> numbers = parseNumbers(text, location);
    const int columns = static_cast<int>(numbers.size());
    if (log.columns == 0) {
      if (columns != 3 && columns != 7 && columns != 9)
        location.fail(std::to_string(columns) + " columns, expected 3 (x y z), 7 (+ qx qy qz qw) or 9 (+ width height)");
      log.columns = columns;
    }
    if (columns != log.columns)
      location.fail(std::to_string(columns) + " columns, expected " + std::to_string(log.columns) + " as in the lines before");
    TrackedObservation observation;
    observation.stamp = static_cast<double>(log.track.observations.size());
    observation.rectangle = parseRectangle(numbers, location, &quaternions);
    requireSane(observation.rectangle, location);
    log.track.observations.push_back(observation);
  }
  if (log.track.observations.empty()) throw PoseLogError(name + ": no poses, expected one a line");
  estimateSize(&log.track);
  log.warning = quaternions.warning();
  return log;
}

PoseLog readPoseLog(const std::string& path) {
  std::istringstream in;
  try {
    in.str(readOrdinaryFile(path, kLargestLog));
  } catch (const std::runtime_error& error) {
    throw PoseLogError(path + ": " + error.what());
  }
  return readPoseLog(in, path);
}

void writePoseLog(const Track& track, std::ostream& out) {
  out << "# x y z qx qy qz qw width height; track " << track.id << "\n";
  out.precision(9);
  for (const TrackedObservation& observation : track.observations) {
    const Rectangle& rectangle = observation.rectangle;
    const Eigen::Vector3d corner = rectangle.corners()[0];
    const Eigen::Quaterniond q(rectangle.pose.linear());
    for (const double value : {corner.x(), corner.y(), corner.z(), q.x(), q.y(), q.z(), q.w(), rectangle.width})
      out << value << ' ';
    out << rectangle.height << '\n';
  }
}

}  // namespace cabinet_articulation::core
