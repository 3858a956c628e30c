// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "allocation_counter.h"
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

TEST(PlaneSegmenterMemory, OnlyTheMasksAreNewInEveryFrame) {
  const SyntheticPair pair({640, 480}, {{{0.002, 0.003, 33}, {-100, -100, 900, 700}},
                                        {{0.05, 0.001, 30}, {100, 50, 200, 300}},
                                        {{0.001, -0.02, 50}, {400, 200, 120, 50}}});
  const DepthFrame frame = BlockMatcher(StereoConfig()).process(pair.left, pair.right, testCamera());
  PlaneSegmenter segmenter{PlanesConfig()};
  for (int i = 0; i < 2; ++i) segmenter.process(frame);
  const evaluation::Allocations before = evaluation::allocations();
  const auto regions = segmenter.process(frame);
  const evaluation::Allocations after = evaluation::allocations();
  ASSERT_EQ(regions.size(), 3U);
  const std::int64_t pixels = frame.disparity.total();
  const std::int64_t bytes = after.bytes - before.bytes;
  EXPECT_GT(bytes, 3 * pixels) << "three masks";
  EXPECT_LT(bytes, 4 * pixels) << "and outlines, but nothing more of the size of an image";
}

}  // namespace
}  // namespace cabinet_articulation::core
