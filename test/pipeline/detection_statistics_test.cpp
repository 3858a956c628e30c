// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "cabinet_articulation/planes/plane_segmenter.h"
#include "cabinet_articulation/rectangles/rectangle_detector.h"
#include "cabinet_articulation/simulation/simulated_stereo_camera.h"
#include "cabinet_articulation/stereo/block_matcher.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kLeastOpening = 0.05;  ///< [m]
constexpr double kLeastOverlap = 0.7;   ///< IoU of a detection with the front that it shows

/// Errors in units of the standard deviation that the detector itself reports, and how far the edges lie off.
struct Errors {
  std::vector<double> along_normal, tilt, in_plane, turn;
  std::vector<double> size;  ///< [m] of sides whose edges were both observed
  int fronts = 0, found = 0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

std::optional<DetectedRectangle> detectionOf(const Rectangle& front, const std::vector<DetectedRectangle>& detections) {
  for (const DetectedRectangle& detection : detections)
    if (intersectionOverUnion(front, detection.rectangle) > kLeastOverlap &&
        std::abs(front.plane().distance(detection.rectangle.center())) < 0.03)
      return detection;
  return std::nullopt;
}

void add(const Rectangle& front, const DetectedRectangle& detection, Errors* errors) {
  const Rectangle truth = alignDescription(front, detection.rectangle, true);
  const Eigen::Matrix3d R = detection.rectangle.pose.linear();
  const Eigen::AngleAxisd turn(R * truth.pose.linear().transpose());
  Eigen::Matrix<double, 6, 1> error;
  error << R.transpose() * (detection.rectangle.center() - truth.center()), R.transpose() * (turn.angle() * turn.axis());
  Matrix6d to_front = Matrix6d::Zero();
  to_front.topLeftCorner<3, 3>() = to_front.bottomRightCorner<3, 3>() = R.transpose();
  const Eigen::Array<double, 6, 1> sigma = (to_front * detection.covariance * to_front.transpose()).diagonal().array().sqrt();
  const Eigen::Array<double, 6, 1> normalised = error.array().abs() / sigma;
  errors->along_normal.push_back(normalised[2]);
  errors->tilt.insert(errors->tilt.end(), {normalised[3], normalised[4]});
  errors->turn.push_back(normalised[5]);
  for (const int axis : {0, 1}) {
    if (std::min(detection.edge_support[2 * axis], detection.edge_support[2 * axis + 1]) < 0.5F) continue;
    errors->in_plane.push_back(normalised[axis]);
    errors->size.push_back(axis == 0 ? detection.rectangle.width - truth.width : detection.rectangle.height - truth.height);
  }
}

/// Every `step`-th frame of a simulated scene, each on its own.
void collect(const std::string& scene, int seed, int step, Errors* errors) {
  SimulationConfig config;
  config.scene = scene;
  config.scene_seed = config.pattern_seed = config.noise_seed = seed;
  SimulatedStereoCamera simulation(config);
  BlockMatcher stereo{StereoConfig{}};
  PlaneSegmenter planes{PlanesConfig{}};
  RectangleDetector detector{RectanglesConfig{}, PlanesConfig{}};
  for (int i = 0; i < simulation.frameCount(); i += step)
    for (const FrontTruth& front : simulation.truth(i).joints) {
      if (std::abs(front.q) * (front.type == JointType::kRotational ? front.rectangle.width : 1) < kLeastOpening) continue;
      const StereoFrame images = simulation.frame(i);
      const DepthFrame frame = stereo.process(images.left, images.right, simulation.camera());
      const auto detection = detectionOf(front.rectangle, detector.process(frame, planes.process(frame)));
      ++errors->fronts;
      if (!detection) continue;
      ++errors->found;
      add(front.rectangle, *detection, errors);
    }
}

class DetectionStatistics : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    errors_ = new Errors;
    for (const int seed : {21, 22}) {
      collect("pedestal", seed, 20, errors_);
      collect("drawer", seed, 12, errors_);
      collect("door", seed, 18, errors_);
    }
  }
  static void TearDownTestSuite() { delete errors_; }

  /// The median of |error| / sigma of a normal distribution is 0.67.
  static void expectConsistent(const std::vector<double>& normalised) {
    EXPECT_GT(median(normalised), 0.67 / 2.2);
    EXPECT_LT(median(normalised), 0.67 * 2.2);
  }

  static Errors* errors_;
};

Errors* DetectionStatistics::errors_ = nullptr;

TEST_F(DetectionStatistics, OpenFrontsAreFound) {
  ASSERT_GE(errors_->fronts, 25);
  EXPECT_GE(errors_->found, 0.9 * errors_->fronts);
}

TEST_F(DetectionStatistics, ErrorsAreAsLargeAsTheCovarianceSays) {
  expectConsistent(errors_->along_normal);
  expectConsistent(errors_->tilt);
  expectConsistent(errors_->in_plane);
  expectConsistent(errors_->turn);
}

TEST_F(DetectionStatistics, SizesHaveLittleBias) {
  // Bodies, side faces and neighbours follow the edges; 6 mm are three pixels.
  EXPECT_LT(std::abs(median(errors_->size)), 0.003);
  std::vector<double> absolute;
  for (const double error : errors_->size) absolute.push_back(std::abs(error));
  EXPECT_LT(median(absolute), 0.006);
}

}  // namespace
}  // namespace cabinet_articulation::core
