// SPDX-License-Identifier: BSD-3-Clause
#include "bend/sensor_bend.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cabinet_articulation/planes/plane_segmenter.h"
#include "geometry/degrees.h"
#include "simulation/cabinet_scenes.h"
#include "simulation/stereo_renderer.h"

namespace cabinet_articulation::core {
namespace {

using Eigen::Vector3d;

const StereoCamera kKinect{640, 480, 525, 525, 319.5, 239.5, 0.075, 0};

/// A kitchen as a depth camera sees it.
class Kitchen {
 public:
  Kitchen() {
    SimulationConfig config;
    config.scene = "door";
    scene_ = makeScene(config);
    config.shadows = false;
    renderer_ = std::make_unique<StereoRenderer>(config, kKinect);
  }

  void openDoor(double angle) { angle_ = angle; }
  void bend(const cv::Mat1f& bend) { bend_ = bend; }

  /// With a Kinect's noise and steps of 1/8 px.
  DepthFrame seenFrom(const Vector3d& eye, const Vector3d& target) {
    const Eigen::Isometry3d T_camera_world = lookAt(eye, target).inverse();
    std::vector<Surface> surfaces = scene_.surfacesAt({angle_});
    for (Surface& surface : surfaces) surface.rectangle.pose = T_camera_world * surface.rectangle.pose;
    const cv::Mat1f& depth = renderer_->render(surfaces).depth;
    DepthFrame frame{kKinect, cv::Mat1f(depth.size(), 0.0F), {}, {}};
    for (int v = 0; v < depth.rows; ++v)
      for (int u = 0; u < depth.cols; ++u) {
        if (!(depth(v, u) > 0)) continue;
        const double exact = kKinect.disparity(depth(v, u)) + (bend_.empty() ? 0 : bend_(v, u));
        frame.disparity(v, u) = static_cast<float>(std::round((exact + random_.gaussian(0.1)) * 8) / 8);
      }
    return frame;
  }

  /// A camera that is carried about and looks around.
  DepthFrame onTour(int i) {
    const double t = 0.1 * i;
    const Vector3d eye(1.3 * std::sin(0.37 * t), -1.7 + 0.6 * std::sin(0.61 * t + 1), 1.2 + 0.4 * std::sin(0.83 * t + 2));
    const Vector3d target(eye.x() + 1.2 * std::sin(0.71 * t), 0, 0.9 + 0.8 * std::sin(0.53 * t));
    return seenFrom(eye, target);
  }

 private:
  Scene scene_;
  std::unique_ptr<StereoRenderer> renderer_;
  double angle_ = 0;  ///< [rad] of the door
  cv::Mat1f bend_;    ///< [px]
  cv::RNG random_{1};
};

class SensorBendOnTour : public testing::Test {
 protected:
  void show(const DepthFrame& frame) { bend_.learn(frame, planes_.process(bend_.correct(frame), bend_.remaining())); }

  cv::Mat1f found() const {
    cv::Mat1f image;
    BendBasis({kKinect.width, kKinect.height}).draw(bend_.bend(), &image);
    return image;
  }

  Kitchen kitchen_;
  PlaneSegmenter planes_{PlanesConfig()};
  SensorBend bend_;
};

/// A dome of 1 px in the middle of the image, which no polynomial is, without the plane that fits it best.
cv::Mat1f dome() {
  cv::Mat1f image(kKinect.height, kKinect.width);
  for (int v = 0; v < image.rows; ++v)
    for (int u = 0; u < image.cols; ++u) {
      const double x = u / 320.0 - 1, y = v / 240.0 - 1;
      image(v, u) = static_cast<float>(std::exp(-(x * x + y * y)));
    }
  return image - cv::mean(image)[0];
}

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
    Kitchen kitchen;
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
