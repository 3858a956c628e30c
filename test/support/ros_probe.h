// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace cabinet_articulation {
namespace test {

/// Enough for a machine that is busy with other things; nothing waits this long when all is well.
constexpr double kGenerous = 30;  // [s]

/// Handles callbacks until `done` or until time is up; tells which.
inline bool spinUntil(const std::function<bool()>& done, double seconds = kGenerous) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  do {
    ros::spinOnce();
    if (done()) return true;
    ros::WallDuration(0.005).sleep();
  } while (ros::ok() && ros::WallTime::now() < end);
  return false;
}

inline void spinFor(double seconds) {
  spinUntil([] { return false; }, seconds);
}

/// What a topic delivered.
template <class Message>
class Recorder {
 public:
  explicit Recorder(const std::string& topic, std::uint32_t queue = 100)
      : subscriber_(ros::NodeHandle().subscribe<Message>(
            topic, queue, [this](const boost::shared_ptr<const Message>& message) { messages.push_back(message); })) {}

  std::uint32_t publishers() const { return subscriber_.getNumPublishers(); }
  bool connected() const { return publishers() > 0; }

  std::vector<boost::shared_ptr<const Message>> messages;

 private:
  ros::Subscriber subscriber_;
};

/// /diagnostics and /rosout, searchable.
class Reports {
 public:
  /// The newest message of the status whose name contains `name`; empty before the first.
  std::string status(const std::string& name) const { return newest(name).message; }

  /// The newest value of `key` beside it; empty if there is none.
  std::string value(const std::string& name, const std::string& key) const {
    for (const diagnostic_msgs::KeyValue& entry : newest(name).values)
      if (entry.key == key) return entry.value;
    return "";
  }

  bool statusHas(const std::string& name, const std::string& text) const { return status(name).find(text) != std::string::npos; }

  /// True once the logs of `nodes` nodes come in, the test's own included.
  bool hears(std::uint32_t nodes) const { return log_.publishers() >= nodes; }

  bool logged(std::uint8_t level, const std::string& text) const {
    for (const auto& entry : log_.messages)
      if (entry->level == level && entry->msg.find(text) != std::string::npos) return true;
    return false;
  }

 private:
  diagnostic_msgs::DiagnosticStatus newest(const std::string& name) const {
    diagnostic_msgs::DiagnosticStatus found;
    for (const auto& array : diagnostics_.messages)
      for (const auto& entry : array->status)
        if (entry.name.find(name) != std::string::npos) found = entry;
    return found;
  }

  Recorder<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
  Recorder<rosgraph_msgs::Log> log_{"/rosout"};
};

}  // namespace test
}  // namespace cabinet_articulation
