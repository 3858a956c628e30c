// SPDX-License-Identifier: BSD-3-Clause
#include "tools/truth/soak_record.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "tools/truth/truth_comparison.h"

namespace cabinet_articulation {
namespace {

using Outcome = Judgement::Outcome;

const char* const kStages[] = {"stereo", "planes", "rectangles", "tracking", "articulation"};
constexpr double kMinute = 60;

template <class... Arguments>
std::string text(const char* pattern, Arguments... arguments) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, pattern, arguments...);
  return buffer;
}

const char* nameOf(Outcome outcome) {
  return outcome == Outcome::kHeld ? "held" : outcome == Outcome::kFailed ? "FAILED" : "not judged";
}

/// Compares the last fifth of a run with the second: the first holds the start. A growth by less than `by` is none.
Judgement judgeGrowth(const std::string& what, const Series& series, double duration, double factor, double by) {
  const double early = series.median(0.2 * duration, 0.4 * duration), late = series.median(0.8 * duration, duration);
  const bool held = late <= std::max(factor * early, early + by);
  return {held ? Outcome::kHeld : Outcome::kFailed,
          what + text(": median %.1f in the second fifth of the run, %.1f in the last", early, late)};
}

}  // namespace

std::vector<double> Series::between(double from, double to) const {
  std::vector<double> values;
  for (const auto& [time, value] : values_)
    if (time >= from && time < to) values.push_back(value);
  return values;
}

double Series::median(double from, double to) const {
  std::vector<double> values = between(from, to);
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

JointWatch& SoakRecord::watch(const JointTruth& joint) {
  for (JointWatch& watch : joints_)
    if (watch.name() == joint.name) return watch;
  joints_.emplace_back(joint);
  return joints_.back();
}

void SoakRecord::addFrame(double time, double wall, const SceneTruth& truth, const std::vector<core::LearnedModel>& models) {
  for (const JointTruth& joint : truth.joints) watch(joint).add(time, joint, models, is_remembered_);
  last_truth_ = truth;
  wall_.add(time, wall);
  objects_.add(time, static_cast<double>(models.size()));
  int observations = 0;
  for (const core::LearnedModel& model : models) {
    observations = std::max(observations, model.observations);
    highest_id_ = std::max(highest_id_, model.id);
  }
  observations_.add(time, observations);
}

void SoakRecord::addLostFrame(double time, const SceneTruth& truth) {
  for (const JointTruth& joint : truth.joints) watch(joint).addLost(time);
  ++lost_;
}

std::string SoakRecord::heading() {
  std::string line = text("%6s %7s %8s %8s", "minute", "RSS/MB", "frames/s", "delay/ms");
  for (const char* stage : kStages) line += text(" %12s", stage);
  return line + text(" %7s %7s %7s  %s", "objects", "max. id", "longest", "joints, and the share of frames since first known");
}

std::string SoakRecord::minute(double from, double to) const {
  const std::vector<double> wall = wall_.between(from, to);
  const double rate = wall.size() > 1 ? static_cast<double>(wall.size() - 1) / (wall.back() - wall.front()) : 0;
  std::string line = text("%6.1f %7.1f %8.1f %8.1f", to / kMinute, memory_.median(from, to), rate, latency_.median(from, to));
  for (const char* stage : kStages) {
    const auto series = stages_.find(stage);
    line += text(" %12.2f", series == stages_.end() ? std::nan("") : series->second.median(from, to));
  }
  line += text(" %7.0f %7u %7.0f ", objects_.median(from, to), highest_id_, observations_.empty() ? 0 : observations_.newest());
  for (const JointWatch& joint : joints_)
    line += text(" %s: %s %.1f %%", joint.name().c_str(), joint.now(), 100 * joint.knownShare());
  return lost_ > 0 ? line + text(", %d frames lost", lost_) : line;
}

Judgement SoakRecord::judgeJoint(const JointWatch& joint, const SoakLimits& limits) const {
  const char* const name = joint.name().c_str();
  if (!joint.everKnown()) return {Outcome::kFailed, text("%s was never known", name)};
  std::string words = text("%s known in %.2f %% of the frames since %.1f s", name, 100 * joint.knownShare(), joint.firstKnown());
  if (joint.rememberedShare() > 0) words += text(" (%.2f %% from memory, out of sight)", 100 * joint.rememberedShare());
  if (joint.longestGap() > 0) words += text(", unknown for up to %.1f s, at %.1f s", joint.longestGap(), joint.longestGapStart());
  if (joint.framesAsOther() > 0) words += text(", taken for %s in %d frames", joint.otherType(), joint.framesAsOther());
  const bool held = joint.knownShare() >= limits.known_share && joint.framesAsOther() == 0;
  return {held ? Outcome::kHeld : Outcome::kFailed, words};
}

Judgement SoakRecord::judgeMemory(double duration, const SoakLimits& limits) const {
  const double early = memory_.median(limits.settled - kMinute, limits.settled);
  double late = 0;
  for (double from = limits.settled; from < duration; from += kMinute)
    late = std::max(late, memory_.median(from, std::min(from + kMinute, duration)));
  return {late - early < limits.memory_growth ? Outcome::kHeld : Outcome::kFailed,
          text("memory: %.1f MB after %.0f minutes, at most %.1f MB later", early, limits.settled / kMinute, late)};
}

Judgement SoakRecord::judgeSaved(const std::vector<core::LearnedModel>& saved) const {
  size_t right = 0;
  std::string missing;
  for (const JointTruth& joint : last_truth_.joints) {
    const core::Rectangle front{fromMessage(joint.pose), joint.width, joint.height};
    const bool found = std::any_of(saved.begin(), saved.end(), [&](const core::LearnedModel& model) {
      return static_cast<int>(model.type) == joint.type && distanceToModel(model, front) < kFoundWithin;
    });
    if (found)
      ++right;
    else
      missing += " without " + joint.name;
  }
  const bool held = missing.empty() && saved.size() == right;
  return {held ? Outcome::kHeld : Outcome::kFailed,
          text("saved: %zu fronts where %zu move", saved.size(), last_truth_.joints.size()) + missing};
}

std::vector<Judgement> SoakRecord::judge(double duration, const std::vector<core::LearnedModel>& saved,
                                         const SoakLimits& limits) const {
  std::vector<Judgement> judgements;
  for (const JointWatch& joint : joints_) judgements.push_back(judgeJoint(joint, limits));
  judgements.push_back(judgeSaved(saved));
  if (duration <= limits.settled) {
    judgements.push_back({Outcome::kNotJudged, text("memory, objects and times: that takes more than %.0f minutes of stamps",
                                                    limits.settled / kMinute)});
    return judgements;
  }
  judgements.push_back(judgeMemory(duration, limits));
  judgements.push_back(judgeGrowth("objects", objects_, duration, limits.growth, limits.objects));
  for (const char* stage : kStages) {
    const auto series = stages_.find(stage);
    if (series == stages_.end())
      judgements.push_back({Outcome::kFailed, text("%s did not say how long it takes", stage)});
    else
      judgements.push_back(judgeGrowth(text("%s [ms]", stage), series->second, duration, limits.growth, limits.milliseconds));
  }
  return judgements;
}

bool allHeld(const std::vector<Judgement>& judgements) {
  return std::none_of(judgements.begin(), judgements.end(),
                      [](const Judgement& judgement) { return judgement.outcome == Outcome::kFailed; });
}

std::string format(const std::vector<Judgement>& judgements) {
  std::string lines, failures;
  for (const Judgement& judgement : judgements) {
    lines += text("%-12s", nameOf(judgement.outcome)) + judgement.text + "\n";
    if (judgement.outcome == Outcome::kFailed) failures += (failures.empty() ? "" : "; ") + judgement.text;
  }
  return lines + (failures.empty() ? "everything held\n" : "failed: " + failures + "\n");
}

}  // namespace cabinet_articulation
