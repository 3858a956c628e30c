// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <map>
#include <mutex>
#include <string>

namespace cabinet_articulation {

/// What a stage knows about its own running, for /diagnostics. Times are seconds of a clock that only goes forward.
/// Safe to use from several threads.
class StageHealth {
 public:
  /// The stage cannot run at all; `reason` stays.
  void refuse(const std::string& reason);

  /// Somebody listens to the stage, so it works; or nobody does.
  void setActive(bool active, double now);

  /// Simulated time stands still: a bag that is paused or over is no trouble.
  void setPaused(bool paused, double now);

  /// A frame was processed; `age` [s] is how long ago it was measured.
  void processed(double age, double milliseconds, double now);

  /// A frame was replaced by a newer one before its turn came.
  void dropped();

  /// A number worth knowing, shown with the others.
  void note(const std::string& name, double value);

  /// Something is wrong, in words. One trouble for each key; it is shown for some seconds after it was last reported, also while
  /// the stage is idle. True if it is time to log it (again).
  bool trouble(const std::string& key, const std::string& text, double now);

  /// A trouble that stays, also while the stage is idle, until it is set to an empty text.
  void setLasting(const std::string& key, const std::string& text);

  /// The rate is that since the last call.
  void describe(double now, diagnostic_updater::DiagnosticStatusWrapper* status);

 private:
  struct Trouble {
    std::string text;
    double reported = 0;
    double logged = 0;
    double log_again = 0;  ///< [s] after `logged`; grows, so that a trouble that stays does not fill the log
  };

  std::string lastingText() const;
  std::string troubleText(double now) const;
  void summarize(double now, double rate, diagnostic_updater::DiagnosticStatusWrapper* status) const;

  std::mutex mutex_;
  std::string refusal_;
  bool active_ = false;
  bool paused_ = false;
  double last_processed_ = 0;
  double last_described_ = 0;
  double age_ = 0;
  double milliseconds_ = 0;
  unsigned processed_ = 0;
  unsigned processed_before_ = 0;
  unsigned dropped_ = 0;
  std::map<std::string, double> notes_;
  std::map<std::string, Trouble> troubles_;
  std::map<std::string, std::string> lasting_;
};

}  // namespace cabinet_articulation
