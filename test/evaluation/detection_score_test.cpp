// SPDX-License-Identifier: BSD-3-Clause
#include "scores/detection_score.h"

#include <gtest/gtest.h>

#include "geometry/degrees.h"

namespace cabinet_articulation::core::evaluation {
namespace {

class DetectionScoreTest : public testing::Test {
 protected:
  DetectionScoreTest() {
    truth_.pose.translation() = Eigen::Vector3d(0.1, -0.2, 1.5);
    truth_.pose.rotate(Eigen::AngleAxisd(2.5, Eigen::Vector3d(1, 0.2, -0.1).normalized()));
    truth_.width = 0.4;
    truth_.height = 0.2;
    seen_ = truth_;
  }

  DetectionScore score() const {
    DetectedRectangle detection;
    detection.rectangle = seen_;
    return scoreDetection(truth_, {detection});
  }

  Rectangle truth_, seen_;
};

TEST_F(DetectionScoreTest, TheTruthItselfHasNoError) {
  const DetectionScore score = this->score();
  EXPECT_TRUE(score.detected);
  EXPECT_NEAR(score.iou, 1, 1e-6);
  EXPECT_NEAR(score.center + score.normal + score.in_plane + score.width + score.height, 0, 1e-6);
}

TEST_F(DetectionScoreTest, AnyDescriptionOfTheSameRectangleIsTheSame) {
  for (int k = 0; k < kDescriptions; ++k) {
    seen_ = describe(truth_, k);
    const DetectionScore score = this->score();
    EXPECT_TRUE(score.detected) << k;
    EXPECT_NEAR(score.normal + score.in_plane + std::abs(score.width) + std::abs(score.height), 0, 1e-6) << k;
  }
}

TEST_F(DetectionScoreTest, MeasuresEachError) {
  seen_.pose.translate(Eigen::Vector3d(0.003, 0, 0.004));
  seen_.width += 0.006;
  DetectionScore score = this->score();
  EXPECT_NEAR(score.center, 0.005, 1e-9);
  EXPECT_NEAR(score.offset, 0.004, 1e-9);
  EXPECT_NEAR(score.width, 0.006, 1e-9);
  seen_ = truth_;
  seen_.pose.rotate(Eigen::AngleAxisd(2 * kDegree, Eigen::Vector3d::UnitZ()));
  EXPECT_NEAR(this->score().in_plane, 2 * kDegree, 1e-9);
  seen_ = truth_;
  seen_.pose.rotate(Eigen::AngleAxisd(5 * kDegree, Eigen::Vector3d::UnitX()));
  score = this->score();
  EXPECT_NEAR(score.normal, 5 * kDegree, 1e-9);
  EXPECT_TRUE(score.detected);
}

TEST_F(DetectionScoreTest, RejectsWhatIsTooFarOff) {
  seen_.pose.translate(Eigen::Vector3d(0, 0, 0.031));
  EXPECT_FALSE(score().detected);
  seen_ = truth_;
  seen_.pose.rotate(Eigen::AngleAxisd(6.1 * kDegree, Eigen::Vector3d::UnitX()));
  EXPECT_FALSE(score().detected);
  seen_ = truth_;
  seen_.width *= 1.27;  // IoU 1 / 1.27 < 0.8
  EXPECT_FALSE(score().detected);
}

TEST_F(DetectionScoreTest, NothingOverlaps) {
  EXPECT_EQ(scoreDetection(truth_, {}).best, -1);
  seen_.pose.translate(Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(score().best, -1);
  EXPECT_FALSE(score().detected);
}

TEST_F(DetectionScoreTest, OnlyFrontsThatStandOutCanBeDetected) {
  Front front;
  front.opened = 0.04;
  EXPECT_TRUE(canBeDetected(front));
  Front changed = front;
  changed.opened = 0.02;
  EXPECT_FALSE(canBeDetected(changed));
  changed = front;
  changed.visible = 0.4;
  EXPECT_FALSE(canBeDetected(changed));
  changed = front;
  changed.in_image = 0.9;
  EXPECT_FALSE(canBeDetected(changed));
  changed = front;
  changed.faces_camera = false;
  EXPECT_FALSE(canBeDetected(changed));
}

}  // namespace
}  // namespace cabinet_articulation::core::evaluation
