// SPDX-License-Identifier: BSD-3-Clause
#include "articulation/learner/range_ends.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace cabinet_articulation::core {
namespace {

RangeEnds endsOf(const std::vector<double>& q) {
  std::vector<double> stamps;
  for (std::size_t i = 0; i < q.size(); ++i) stamps.push_back(static_cast<double>(i) / 10);
  return seenEnds(q, stamps, *std::min_element(q.begin(), q.end()), *std::max_element(q.begin(), q.end()));
}

TEST(RangeEnds, RestIsAnEnd) {
  const RangeEnds ends = endsOf({0, 0, 0.001, 0, 0, 0, 0, 0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3});
  EXPECT_TRUE(ends.min);
  EXPECT_FALSE(ends.max) << "still on its way";
}

TEST(RangeEnds, TurningRoundOnceIsNone) {
  const RangeEnds ends = endsOf({0, 0.1, 0.2, 0.3, 0.2, 0.1, 0.05});
  EXPECT_FALSE(ends.min);
  EXPECT_FALSE(ends.max);
}

TEST(RangeEnds, TurningRoundTwiceAtTheSamePlaceIsOne) {
  const RangeEnds ends = endsOf({0.1, 0.2, 0.3, 0.2, 0.1, 0.2, 0.297, 0.2});
  EXPECT_TRUE(ends.max);
  EXPECT_TRUE(ends.min);
  EXPECT_FALSE(endsOf({0.1, 0.2, 0.3, 0.2, 0.05, 0.2, 0.25, 0.2}).max) << "not the same place";
}

TEST(RangeEnds, WhatDoesNotMoveHasNone) {
  EXPECT_FALSE(endsOf({0, 0, 0, 0, 0, 0, 0, 0, 0, 0}).min);
  EXPECT_FALSE(seenEnds({}, {}, 0, 0).max);
}

}  // namespace
}  // namespace cabinet_articulation::core
