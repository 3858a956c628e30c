// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include "kinds/fronts_elsewhere.h"
#include "kinds/kind_memory.h"

namespace cabinet_articulation::core::test {

/// As a detector sees the front, with the id i + 1.
inline Track seen(const SyntheticFront& front, int i, double q_end) {
  Track track = reported(trackAt(front, i, q_end, standing), front.noise, front.turn_noise);
  track.id = static_cast<std::uint32_t>(i + 1);
  return track;
}

inline std::vector<LearnedModel> completed(const std::vector<Track>& tracks, KindMemory* memory) {
  std::vector<LearnedModel> models;
  for (const Track& track : tracks) models.push_back(learn(track));
  memory->complete(tracks, &models);
  return models;
}

/// Doors at `count` places, opened widely.
inline void teach(const SyntheticFront& front, int count, KindMemory* memory) {
  for (int i = 0; i < count; ++i) completed({seen(front, i, 1.5)}, memory);
}

inline std::size_t votes(const KindMemory& memory) { return memory.votesBeside({}).size(); }

inline void expectSame(const LearnedModel& a, const LearnedModel& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.probabilities, b.probabilities);
  EXPECT_EQ(a.origin.matrix(), b.origin.matrix());
  EXPECT_EQ(a.axis, b.axis);
  EXPECT_EQ(a.axis_point, b.axis_point);
  EXPECT_EQ(a.q_max, b.q_max);
  EXPECT_EQ(a.observed, b.observed);
}

}  // namespace cabinet_articulation::core::test
