// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <functional>
#include <string>
#include <utility>

namespace cabinet_articulation {

/// The one way by which ROS calls into a stage. An exception that escaped into ROS would end the manager with all its stages;
/// here it becomes a report in words.
class CallbackGuard {
 public:
  /// Told where something went wrong (a topic or a task) and what, in words that name the place too. Must not throw.
  using Report = std::function<void(const std::string& where, const std::string& what)>;

  explicit CallbackGuard(Report report) : report_(std::move(report)) {}

  /// Runs `work`; never throws.
  template <class Work>
  void operator()(const std::string& where, const Work& work) const {
    try {
      work();
    } catch (const std::exception& error) {
      report_(where, where + ": " + error.what());
    } catch (...) {
      report_(where, where + ": unknown error");
    }
  }

 private:
  Report report_;
};

}  // namespace cabinet_articulation
