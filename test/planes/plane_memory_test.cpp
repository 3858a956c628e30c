// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "allocation_counter.h"
#include "cabinet_articulation/planes/plane_segmenter.h"
#include "cabinet_articulation/stereo/block_matcher.h"
#include "stereo/synthetic_pair.h"

namespace cabinet_articulation::core {
namespace {

class PlaneSegmenterMemory : public testing::Test {
 protected:
  PlaneSegmenterMemory() {
    for (int i = 0; i < 2; ++i) segmenter_.process(frame_);
  }

  /// The bytes that the next frame takes from the heap, `regions` of which come out.
  std::int64_t bytesOfAFrame(size_t regions) {
    const std::int64_t before = evaluation::allocations().bytes;
    const std::vector<PlaneRegion> found = segmenter_.process(frame_);
    const std::int64_t after = evaluation::allocations().bytes;
    EXPECT_EQ(found.size(), regions);
    return after - before;
  }

  const SyntheticPair pair_{{640, 480},
                            {{{0.002, 0.003, 33}, {-100, -100, 900, 700}},
                             {{0.05, 0.001, 30}, {100, 50, 200, 300}},
                             {{0.001, -0.02, 50}, {400, 200, 120, 50}}}};
  const DepthFrame frame_ = BlockMatcher(StereoConfig()).process(pair_.left, pair_.right, testCamera());
  const std::int64_t pixels_ = static_cast<std::int64_t>(frame_.disparity.total());
  PlaneSegmenter segmenter_{PlanesConfig()};
};

TEST_F(PlaneSegmenterMemory, AFrameTakesNothingOfTheSizeOfAnImage) {
  EXPECT_LT(bytesOfAFrame(3), pixels_) << "outlines and the libraries' small change, together less than one mask";
}

TEST_F(PlaneSegmenterMemory, MasksThatAreStillHeldAreLeftAlone) {
  const std::vector<PlaneRegion> held = segmenter_.process(frame_);
  const cv::Mat1b copy = held[0].mask.clone();
  EXPECT_GT(bytesOfAFrame(3), 3 * pixels_);
  EXPECT_EQ(cv::countNonZero(copy != held[0].mask), 0);
}

}  // namespace
}  // namespace cabinet_articulation::core
