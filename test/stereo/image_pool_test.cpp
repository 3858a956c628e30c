// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/image_pool.h"

#include <gtest/gtest.h>

namespace cabinet_articulation::core {
namespace {

const cv::Size kSize(64, 4);

TEST(ImagePool, LendsMemoryAgainOnceItIsReleased) {
  ImagePool<cv::Mat1b> pool(2);
  cv::Mat1b mask = pool.take(kSize);
  const void* const memory = mask.data;
  mask.release();
  EXPECT_EQ(pool.take(kSize).data, memory);
}

TEST(ImagePool, NeverLendsWhatSomebodyHolds) {
  ImagePool<cv::Mat1b> pool(2);
  cv::Mat1b first = pool.take(kSize);
  const cv::Mat1b copy = first;
  const void* const memory = first.data;
  first.release();
  EXPECT_NE(pool.take(kSize).data, memory) << "the copy shares it";
}

TEST(ImagePool, LendsMoreThanItKeeps) {
  ImagePool<cv::Mat1b> pool(1);
  const cv::Mat1b first = pool.take(kSize), second = pool.take(kSize), third = pool.take(kSize);
  EXPECT_NE(first.data, second.data);
  EXPECT_NE(second.data, third.data);
}

TEST(ImagePool, FollowsTheSizeOfTheImage) {
  ImagePool<cv::Mat1b> pool(1);
  pool.take(kSize);
  const cv::Size larger(128, 8);
  const void* const memory = pool.take(larger).data;
  EXPECT_EQ(pool.take(larger).size(), larger);
  EXPECT_EQ(pool.take(larger).data, memory) << "the old size does not fill the pool";
  EXPECT_TRUE(pool.take({}).empty());
}

}  // namespace
}  // namespace cabinet_articulation::core
