// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/JointTruth.h>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "cabinet_articulation/articulation/learned_model.h"

namespace cabinet_articulation {

/// True if the pipeline answers questions about the joint with this id.
using IsRemembered = std::function<bool(std::uint32_t)>;

/// Follows one true joint: is it known, as what, and for how many of the frames since it was first known? A front that nobody
/// sees, such as a closed one that is flush with its neighbours, has no live model; it is known while it is remembered.
class JointWatch {
 public:
  explicit JointWatch(const JointTruth& truth) : name_(truth.name), true_type_(truth.type) {}

  /// The joint in one frame, and all models of that frame, in the same coordinates.
  void add(double stamp, const JointTruth& truth, const std::vector<core::LearnedModel>& models,
           const IsRemembered& is_remembered);

  /// A frame of which no models came.
  void addLost(double stamp);

  const std::string& name() const { return name_; }
  bool everKnown() const { return frames_ > 0; }

  /// [s] stamp of the first frame in which it was known.
  double firstKnown() const { return first_known_; }

  /// Of the frames since then.
  double knownShare() const { return share(known_); }
  double rememberedShare() const { return share(remembered_); }  ///< known, but not in sight

  /// Frames since then in which it was taken for a joint of another type.
  int framesAsOther() const { return as_other_; }
  const char* otherType() const;

  /// [s] The longest time since then without being known, and the stamp of the last frame before.
  double longestGap() const { return longest_gap_; }
  double longestGapStart() const { return longest_gap_start_; }

  /// In words, as what it was known in the newest frame; "-" for nothing.
  const char* now() const;

 private:
  double share(int frames) const { return frames_ > 0 ? static_cast<double>(frames) / frames_ : 0; }
  int typeInSight(const core::Rectangle& front, const std::vector<core::LearnedModel>& models);
  void count(double stamp);

  const std::string name_;
  const int true_type_;
  int type_ = -1;  ///< of the newest frame; -1: not known
  int other_type_ = -1;
  int frames_ = 0, known_ = 0, remembered_ = 0, as_other_ = 0;
  double first_known_ = 0, last_known_ = 0, longest_gap_ = 0, longest_gap_start_ = 0;
  std::set<std::uint32_t> ids_;  ///< under which it was known
};

}  // namespace cabinet_articulation
