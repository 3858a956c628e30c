// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/label_layout.h"

#include <gtest/gtest.h>

#include <random>

namespace cabinet_articulation {
namespace {

const cv::Size kImage(640, 480);

int overlap(const cv::Rect& a, const cv::Rect& b) { return (a & b).area(); }

TEST(LabelLayout, LabelsNeitherOverlapNorLeaveTheImage) {
  std::mt19937 random(1);
  const auto upTo = [&random](int most) { return std::uniform_int_distribution<int>(0, most)(random); };
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<LabelBox> boxes;
    const int count = 1 + upTo(40);
    // Half of the trials crowd into a corner.
    const cv::Size area = trial % 2 == 0 ? kImage : cv::Size(80, 60);
    for (int i = 0; i < count; ++i)
      boxes.push_back({{10 + upTo(150), 12 + upTo(40)}, {upTo(area.width - 1), upTo(area.height - 1)}});
    const auto places = placeLabels(boxes, kImage);
    ASSERT_EQ(places.size(), boxes.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i]) continue;
      ASSERT_EQ(places[i]->size(), boxes[i].size);
      ASSERT_EQ(*places[i] & cv::Rect({}, kImage), *places[i]) << "trial " << trial << ", label " << i;
      for (std::size_t k = 0; k < i; ++k) {
        if (places[k]) {
          ASSERT_EQ(overlap(*places[i], *places[k]), 0) << "trial " << trial << ", labels " << i << " and " << k;
        }
      }
    }
  }
}

TEST(LabelLayout, AFewAlwaysFindRoom) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> x(0, 639), y(0, 479);
  for (int trial = 0; trial < 100; ++trial) {
    const std::vector<LabelBox> boxes(10, {{160, 40}, {x(random), y(random)}});  // all at one place
    for (const auto& place : placeLabels(boxes, kImage)) ASSERT_TRUE(place) << trial;
  }
}

TEST(LabelLayout, WhatIsAloneIsInItsPlace) {
  const auto places = placeLabels({{{100, 20}, {320, 240}}, {{100, 20}, {0, 479}}}, kImage);
  EXPECT_EQ(*places[0], cv::Rect(270, 230, 100, 20));
  EXPECT_EQ(*places[1], cv::Rect(0, 460, 100, 20)) << "moved into the image";
}

TEST(LabelLayout, TheFirstStaysAndTheNextOneGivesWayByAsLittleAsNeeded) {
  const auto places = placeLabels({{{100, 20}, {320, 240}}, {{100, 20}, {320, 245}}}, kImage);
  EXPECT_EQ(*places[0], cv::Rect(270, 230, 100, 20));
  EXPECT_EQ(places[1]->x, 270);
  EXPECT_GE(places[1]->y, 250);
  EXPECT_LE(places[1]->y, 254);
}

TEST(LabelLayout, WhatIsLargerThanTheImageOrFindsNoRoomIsLeftOut) {
  EXPECT_FALSE(placeLabels({{{641, 20}, {320, 240}}}, kImage)[0]);
  const auto places = placeLabels({{{640, 470}, {320, 240}}, {{30, 20}, {320, 240}}}, kImage);
  EXPECT_TRUE(places[0]);
  EXPECT_FALSE(places[1]);
}

}  // namespace
}  // namespace cabinet_articulation
