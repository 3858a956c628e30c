// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/SceneTruth.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "tools/truth/joint_watch.h"

namespace cabinet_articulation {

/// What must hold over a long run.
struct SoakLimits {
  double known_share = 0.99;  ///< of the frames since a joint was first known
  double settled = 600;       ///< [s] from here on nothing may grow; a run that is not longer is not judged on that
  double memory_growth = 5;   ///< [MB]
  double growth = 1.2;        ///< of the median of a stage's time and of the number of objects, second to last fifth of the run
  double milliseconds = 0.3;  ///< what grows by less is not judged: next to nothing may double
  double objects = 2;         ///< the same for the number of objects
};

/// One demand on the run, in words.
struct Judgement {
  enum class Outcome { kHeld, kFailed, kNotJudged };
  Outcome outcome;
  std::string text;
};

/// A value over the time of the stamps.
class Series {
 public:
  void add(double time, double value) { values_.emplace_back(time, value); }

  /// The median of from <= time < to; NaN without values.
  double median(double from, double to) const;
  double newest() const { return values_.back().second; }
  bool empty() const { return values_.empty(); }

  /// The values of from <= time < to.
  std::vector<double> between(double from, double to) const;

 private:
  std::vector<std::pair<double, double>> values_;
};

/// Everything that is looked at during a long run, minute by minute, and the judgement at its end. Times are those of the
/// stamps, in s since the first frame.
class SoakRecord {
 public:
  explicit SoakRecord(IsRemembered is_remembered) : is_remembered_(std::move(is_remembered)) {}

  /// One frame and its models, both in the same coordinates. `wall` [s]: when the models came.
  void addFrame(double time, double wall, const SceneTruth& truth, const std::vector<core::LearnedModel>& models);

  /// A frame of which no models came.
  void addLostFrame(double time, const SceneTruth& truth);

  void addMemory(double time, double megabytes) { memory_.add(time, megabytes); }
  void addLatency(double time, double milliseconds) { latency_.add(time, milliseconds); }
  void addStage(double time, const std::string& stage, double milliseconds) { stages_[stage].add(time, milliseconds); }

  /// What the columns of minute() are.
  static std::string heading();
  std::string minute(double from, double to) const;

  /// `duration` [s] of the stamps. `saved` is what the pipeline wrote at the end, in the coordinates of the last frame.
  std::vector<Judgement> judge(double duration, const std::vector<core::LearnedModel>& saved, const SoakLimits& limits) const;

 private:
  JointWatch& watch(const JointTruth& joint);
  Judgement judgeJoint(const JointWatch& joint, const SoakLimits& limits) const;
  Judgement judgeMemory(double duration, const SoakLimits& limits) const;
  Judgement judgeSaved(const std::vector<core::LearnedModel>& saved) const;

  const IsRemembered is_remembered_;
  std::vector<JointWatch> joints_;
  SceneTruth last_truth_;
  Series memory_, latency_, wall_, objects_, observations_;
  std::map<std::string, Series> stages_;
  std::uint32_t highest_id_ = 0;
  int lost_ = 0;
};

/// One line for each judgement, and a last one that says it all.
std::string format(const std::vector<Judgement>& judgements);
bool allHeld(const std::vector<Judgement>& judgements);

}  // namespace cabinet_articulation
