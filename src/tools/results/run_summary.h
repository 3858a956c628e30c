// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "cabinet_articulation/pipeline/pipeline.h"

namespace cabinet_articulation {

/// How long one stage took for a frame [ms].
struct StageSummary {
  const char* name;
  double median, mean, longest;
};

/// What a run over a bag learned and how long it took, for people to read.
class RunSummary {
 public:
  void add(const core::PipelineResult& result);

  int frames() const { return static_cast<int>(milliseconds_.size()); }

  /// Objects that moved, each as it was last known, and the number of those that did not.
  std::string objects() const;

  int still() const;  ///< objects that did not move

  /// Every stage, and all together; empty if there were no frames.
  std::vector<StageSummary> stages() const;

  /// Median and mean of every stage [ms].
  std::string timing() const;

 private:
  std::map<std::uint32_t, core::LearnedModel> models_;
  std::vector<core::StageTimes> milliseconds_;
};

}  // namespace cabinet_articulation
