// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "allocation_counter.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

class BlockMatcherMemory : public testing::Test {
 protected:
  DepthFrame match() { return matcher_.process(pair_.left, pair_.right, testCamera()); }

  const SyntheticPair pair_{{640, 480}, {{{0.002, 0.003, 33}, {-100, -100, 900, 700}}}};
  BlockMatcher matcher_{StereoConfig()};
};

TEST_F(BlockMatcherMemory, ASteadyFrameTakesNoLargeBlock) {
  for (int i = 0; i < 3; ++i) match();
  const std::int64_t before = evaluation::allocations().bytes;
  const DepthFrame frame = match();
  EXPECT_LT(evaluation::allocations().bytes - before, 4096) << "small change of the threads";
  EXPECT_GT(cv::countNonZero(frame.disparity), 200000);
}

TEST_F(BlockMatcherMemory, FramesThatAreStillHeldAreLeftAlone) {
  std::vector<DepthFrame> held;
  for (int i = 0; i < 7; ++i) {
    held.push_back(match());
    held.back().disparity = static_cast<float>(i);
  }
  for (int i = 0; i < 7; ++i) EXPECT_EQ(cv::countNonZero(held[i].disparity != i), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
