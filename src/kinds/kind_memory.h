// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"
#include "cabinet_articulation/kinds/joint_shape.h"
#include "cabinet_articulation/kinds/kinds_config.h"
#include "cabinet_articulation/tracking/track.h"
#include "kinds/joint_kinds.h"

namespace cabinet_articulation::core {

/**
 * The kinds of joints that a run has seen: learned from fronts that are well known, told to those that are not.
 *
 * A front teaches if its own poses say where its joint is as exactly as joints of one kind are alike (KindsConfig). It then has
 * one vote, which follows its model. Any other front is told what to expect, by all votes but its own. A front that was seen to
 * open widely stays as its own poses say.
 *
 * All models that are given here are as their own poses say. What a front is told goes to whoever asks, and is never given back:
 * its covariance is so small that it would count as taught. So own models are kept and saved.
 *
 * A front that hangs on another one neither teaches nor is told. Up is unknown in the other's frame, and its path in the world
 * is no joint's.
 */
class KindMemory {
 public:
  explicit KindMemory(const LearningConfig& config);

  /// New settings; all votes stay.
  void configure(const LearningConfig& config);

  /// Learns from the models of these tracks, and completes them as told() does, and those at rest whose size was seen. Nothing
  /// changes if `kinds` is false or nothing was taught yet.
  void complete(const std::vector<Track>& tracks, std::vector<LearnedModel>* models);

  /// What kinds say of a front that was seen to move: the model itself if it is well known.
  LearnedModel told(const LearnedModel& model) const;

  /// Forgets everything, and knows these instead: joints of fronts that nobody knows, and fronts that are known.
  void startFrom(const std::vector<JointShape>& past, const std::vector<LearnedModel>& fronts);

  /// Other fronts than these are not known any more. Their votes stay.
  void keepFronts(const std::vector<LearnedModel>& fronts);

  /// The front is not known any more. Its vote stays: such joints do exist.
  void forget(std::uint32_t front);

  void reset() { startFrom({}, {}); }

  const std::vector<JointKind>& kinds() const { return kinds_.kinds(); }

  /// The vote of this front, if it has one.
  std::vector<JointShape> votesOf(std::uint32_t front) const;

  /// The votes of all but these fronts.
  std::vector<JointShape> votesBeside(const std::set<std::uint32_t>& fronts) const;

 private:
  bool isExact(const LearnedModel& model) const;
  void learnFrom(const LearnedModel& model);
  template <class Ask>
  LearnedModel askOthers(const LearnedModel& front, const Ask& ask) const;

  LearningConfig config_;
  JointKinds kinds_;
};

}  // namespace cabinet_articulation::core
