// SPDX-License-Identifier: BSD-3-Clause
#include "bend/sensor_bend.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cabinet_articulation/planes/plane_segmenter.h"
#include "geometry/degrees.h"
#include "support/bent_kitchen.h"

namespace cabinet_articulation::core {
namespace {

using test::dome;
using test::kKinect;

class SensorBendOnTour : public testing::Test {
 protected:
  void show(const DepthFrame& frame) { bend_.learn(frame, planes_.process(bend_.correct(frame), bend_.remaining())); }

  cv::Mat1f found() const {
    cv::Mat1f image;
    BendBasis({kKinect.width, kKinect.height}).draw(bend_.bend(), &image);
    return image;
  }

  test::BentKitchen kitchen_;
  PlaneSegmenter planes_{PlanesConfig()};
  SensorBend bend_;
};

TEST_F(SensorBendOnTour, ABendOfOnePixelIsFound) {
  kitchen_.bend(dome());
  for (int i = 0; i < 250; ++i) show(kitchen_.onTour(i));
  const double error = cv::norm(found() - dome(), cv::NORM_L2) / cv::norm(dome(), cv::NORM_L2);
  EXPECT_LT(error, 0.2) << bend_.inWords();
  EXPECT_LT(bend_.remaining(), kMostBend / 2) << "so smaller folds are found";
}

TEST_F(SensorBendOnTour, TheSameFramesGiveTheSameBits) {
  BendVector first;
  for (int run = 0; run < 2; ++run) {
    test::BentKitchen kitchen;
    kitchen.bend(dome());
    bend_ = SensorBend();
    for (int i = 0; i < 60; ++i) show(kitchen.onTour(4 * i));
    ASSERT_TRUE(bend_.isKnown());
    if (run == 0) first = bend_.bend();
  }
  EXPECT_EQ(bend_.bend(), first);
}

TEST_F(SensorBendOnTour, AnotherCameraBeginsAnew) {
  kitchen_.bend(dome());
  for (int i = 0; i < 60; ++i) show(kitchen_.onTour(4 * i));
  ASSERT_TRUE(bend_.isKnown());
  DepthFrame other = kitchen_.onTour(0);
  other.camera.fx += 1;
  EXPECT_EQ(bend_.correct(other).disparity.data, other.disparity.data);
  EXPECT_EQ(bend_.views(), 0U);
  EXPECT_EQ(bend_.remaining(), kMostBend);
}

TEST_F(SensorBendOnTour, APairIsLeftAlone) {
  kitchen_.bend(dome());
  for (int i = 0; i < 60; ++i) {
    DepthFrame pair = kitchen_.onTour(4 * i);
    pair.left = pair.right = cv::Mat1b(pair.disparity.size(), std::uint8_t{0});
    EXPECT_EQ(bend_.correct(pair).disparity.data, pair.disparity.data);
    if (i % 10 == 0) bend_.learn(pair, planes_.process(pair));
  }
  EXPECT_EQ(bend_.views(), 0U);
  EXPECT_EQ(bend_.inWords(), "");
}

/// What an earlier run learned is taken from the first frame on, and given up for what as many views say.
TEST_F(SensorBendOnTour, AnEarlierBendHoldsUntilAsMuchIsSeenAgain) {
  KnownBend earlier{kKinect, BendVector::Zero(), 40};
  earlier.bend[0] = 0.5;
  bend_.startFrom(earlier);
  EXPECT_NE(bend_.correct(kitchen_.onTour(0)).disparity.data, nullptr);
  EXPECT_NEAR(bend_.largest(), 0.5, 0.01);
  for (int i = 0; i < 10; ++i) show(kitchen_.onTour(8 * i));
  EXPECT_EQ(bend_.bend(), earlier.bend);
  EXPECT_EQ(bend_.views(), 40U);
  for (int i = 10; i < 60; ++i) show(kitchen_.onTour(8 * i));
  EXPECT_LT(bend_.largest(), 0.1) << "the sensor is flat: " << bend_.inWords();
}

TEST_F(SensorBendOnTour, AFlatSensorStaysFlat) {
  for (int i = 0; i < 250; ++i) show(kitchen_.onTour(i));
  EXPECT_LT(bend_.largest(), 0.1) << bend_.inWords();
}

TEST_F(SensorBendOnTour, ADoorAjarIsNoBend) {
  kitchen_.openDoor(4 * kDegree);
  for (int i = 0; i < 250; ++i) show(kitchen_.onTour(i));
  EXPECT_LT(bend_.largest(), 0.1) << bend_.inWords();
}

TEST_F(SensorBendOnTour, ADoorAjarBeforeACameraAtRestIsNoBend) {
  kitchen_.openDoor(4 * kDegree);
  for (int i = 0; i < 100; ++i) show(kitchen_.seenFrom({0.6, -1.3, 1.1}, {0, 0, 0.5}));
  EXPECT_LT(bend_.views(), 12U);
  EXPECT_TRUE(bend_.bend().isZero(0));
}

/// The hardest case: the fold is in the middle of the image all the time.
TEST_F(SensorBendOnTour, ADoorAjarThatTheCameraLooksAtIsNoBend) {
  kitchen_.openDoor(4 * kDegree);
  for (int i = 0; i < 250; ++i) {
    const double t = 0.1 * i;
    show(kitchen_.seenFrom({1.1 * std::sin(0.37 * t), -1.6 + 0.6 * std::sin(0.61 * t), 1.1 + 0.4 * std::sin(0.83 * t)},
                           {0, 0, 0.5}));
  }
  EXPECT_LT(bend_.largest(), 0.1) << bend_.inWords();
}

}  // namespace
}  // namespace cabinet_articulation::core
