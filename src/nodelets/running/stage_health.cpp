// SPDX-License-Identifier: BSD-3-Clause
#include "nodelets/running/stage_health.h"

#include <diagnostic_msgs/DiagnosticStatus.h>

namespace cabinet_articulation {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kShowTrouble = 5;  ///< [s] after it was last reported
constexpr double kLogAgain = 10;    ///< [s] the first time, then twice as long each time
constexpr double kStandstill = 3;   ///< [s] without a frame turns a warning into an error
constexpr double kOldStamp = 60;    ///< [s] no pipeline is that slow: the clocks differ

}  // namespace

void StageHealth::refuse(const std::string& reason) {
  std::lock_guard<std::mutex> lock(mutex_);
  refusal_ = reason;
}

void StageHealth::setActive(bool active, double now) {
  std::lock_guard<std::mutex> lock(mutex_);
  active_ = active;
  last_processed_ = now;
  troubles_.clear();
}

void StageHealth::setPaused(bool paused, double now) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (paused_ && !paused) last_processed_ = now;
  paused_ = paused;
}

void StageHealth::processed(double age, double milliseconds, double now) {
  std::lock_guard<std::mutex> lock(mutex_);
  ++processed_;
  age_ = age;
  milliseconds_ = milliseconds;
  last_processed_ = now;
}

void StageHealth::dropped() {
  std::lock_guard<std::mutex> lock(mutex_);
  ++dropped_;
}

void StageHealth::note(const std::string& name, double value) {
  std::lock_guard<std::mutex> lock(mutex_);
  notes_[name] = value;
}

bool StageHealth::trouble(const std::string& key, const std::string& text, double now) {
  std::lock_guard<std::mutex> lock(mutex_);
  Trouble& trouble = troubles_[key];
  const bool is_new = trouble.text.empty() || now - trouble.reported > kLogAgain;
  trouble.text = text;
  trouble.reported = now;
  if (!is_new && now - trouble.logged < trouble.log_again) return false;
  trouble.log_again = is_new ? kLogAgain : 2 * trouble.log_again;
  trouble.logged = now;
  return true;
}

void StageHealth::setLasting(const std::string& key, const std::string& text) {
  std::lock_guard<std::mutex> lock(mutex_);
  if (text.empty())
    lasting_.erase(key);
  else
    lasting_[key] = text;
}

void StageHealth::describe(double now, diagnostic_updater::DiagnosticStatusWrapper* status) {
  std::lock_guard<std::mutex> lock(mutex_);
  const double rate = now > last_described_ ? (processed_ - processed_before_) / (now - last_described_) : 0;
  last_described_ = now;
  processed_before_ = processed_;
  summarize(now, rate, status);
  for (const auto& entry : lasting_) status->add(entry.first, entry.second);
  for (const auto& entry : troubles_)
    if (now - entry.second.reported <= kShowTrouble) status->add(entry.first, entry.second.text);
  status->addf("rate [Hz]", "%.1f", rate);
  status->addf("age of the newest frame [ms]", "%.0f", 1e3 * age_);
  status->addf("time for the last frame [ms]", "%.1f", milliseconds_);
  status->add("frames processed", processed_);
  status->add("frames dropped for newer ones", dropped_);
  for (const auto& entry : notes_) status->addf(entry.first, "%.4g", entry.second);
}

std::string StageHealth::lastingText() const {
  std::string text;
  for (const auto& entry : lasting_) text += (text.empty() ? "" : "; ") + entry.second;
  return text;
}

std::string StageHealth::troubleText(double now) const {
  std::string text = lastingText();
  for (const auto& entry : troubles_)
    if (now - entry.second.reported <= kShowTrouble) text += (text.empty() ? "" : "; ") + entry.second.text;
  return text;
}

void StageHealth::summarize(double now, double rate, diagnostic_updater::DiagnosticStatusWrapper* status) const {
  if (!refusal_.empty()) return status->summary(DiagnosticStatus::ERROR, "not running: " + refusal_);
  // A trouble from before time stood still says nothing about now.
  const std::string text = active_ && paused_ ? lastingText() : troubleText(now);
  const bool rests = !active_ || paused_;
  const bool stands_still = now - last_processed_ > kStandstill && !rests;
  if (!active_ && text.empty()) return status->summary(DiagnosticStatus::OK, "idle: nobody subscribes to its results");
  if (paused_ && text.empty())
    return status->summary(DiagnosticStatus::OK,
                           "simulated time stands still: the bag or the simulation has not started, is paused or over");
  if (!text.empty()) return status->summary(stands_still ? DiagnosticStatus::ERROR : DiagnosticStatus::WARN, text);
  if (processed_ > 0 && (age_ > kOldStamp || age_ < -kOldStamp))
    return status->summaryf(
        DiagnosticStatus::WARN,
        "the newest frame's stamp is %.0f s from now: the clocks differ, or a bag is played without /use_sim_time", age_);
  if (stands_still) return status->summaryf(DiagnosticStatus::WARN, "no frame for %.0f s", now - last_processed_);
  status->summaryf(DiagnosticStatus::OK, "%.1f Hz, %.0f ms old, %u dropped", rate, 1e3 * age_, dropped_);
}

}  // namespace cabinet_articulation
