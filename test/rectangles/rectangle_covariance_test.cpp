// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/acceptance/rectangle_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "front_scene.h"
#include "rectangles/chart/image_edge.h"

namespace cabinet_articulation::core {
namespace {

class RectangleCovarianceTest : public testing::Test {
 protected:
  RectangleCovarianceTest() { frame_.camera = exampleCamera(); }

  Matrix6d covariance(const Rectangle& front, const std::array<EdgeObservation, 4>& edges) const {
    const PlaneChart chart = *PlaneChart::at(front.plane(), frame_.camera, frame_.camera.project(front.center()));
    return rectangleCovariance(chart, chart.fromSpace(front), edges, finishRegion(frontRegion(front, frame_.camera)), frame_);
  }

  /// Standard deviation along a direction of the front itself (0-2 position, 3-5 rotation).
  static double sigma(const Matrix6d& covariance, const Rectangle& front, int axis) {
    const Eigen::Vector3d direction = front.pose.linear().col(axis % 3);
    return std::sqrt(
        direction.dot((axis < 3 ? covariance.topLeftCorner<3, 3>() : covariance.bottomRightCorner<3, 3>()) * direction));
  }

  static constexpr EdgeObservation kSeen{1, false};
  static constexpr EdgeObservation kUnseen{0, false};
  DepthFrame frame_;
};

TEST_F(RectangleCovarianceTest, IsPositiveDefiniteAndMillimetresForAFullySeenFront) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0.4, 0.2, 0.3);
  const Matrix6d result = covariance(front, {kSeen, kSeen, kSeen, kSeen});
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Matrix6d>(result).eigenvalues().minCoeff(), 0);
  EXPECT_LT((result - result.transpose()).norm(), 1e-15);
  for (const int axis : {0, 1, 2}) EXPECT_LT(sigma(result, front, axis), 0.006) << axis;
  for (const int axis : {3, 4, 5}) EXPECT_LT(sigma(result, front, axis), 0.02) << axis;
}

TEST_F(RectangleCovarianceTest, AnUnseenEdgeFreesTheCentreAcrossItAndNothingElse) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0.4, 0.2, 0.3);
  const Matrix6d all = covariance(front, {kSeen, kSeen, kSeen, kSeen});
  const Matrix6d cut = covariance(front, {kSeen, kUnseen, kSeen, kSeen});
  EXPECT_GT(sigma(cut, front, 0), 0.1);
  EXPECT_NEAR(sigma(cut, front, 1), sigma(all, front, 1), 1e-9);
  EXPECT_NEAR(sigma(cut, front, 2), sigma(all, front, 2), 1e-9);
  EXPECT_LT(sigma(cut, front, 5), 2 * sigma(all, front, 5));
}

TEST_F(RectangleCovarianceTest, AnEdgeThatOnlyANeighbourEndsIsAsGoodAsUnseen) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.6, 0.1, 0, 0);  // a door just opened
  const Matrix6d result = covariance(front, {EdgeObservation{0.25, false}, kSeen, kSeen, kSeen});
  EXPECT_GT(sigma(result, front, 0), 0.1);
  EXPECT_LT(sigma(result, front, 1), 0.006);
}

TEST_F(RectangleCovarianceTest, WithoutAnyEdgeNothingInThePlaneIsKnown) {
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.3, 0, 0, 0);
  const Matrix6d result = covariance(front, {kUnseen, kUnseen, kUnseen, kUnseen});
  EXPECT_GT(sigma(result, front, 0), 0.15);
  EXPECT_GT(sigma(result, front, 1), 0.15);
  EXPECT_GT(sigma(result, front, 5), 0.2);
  EXPECT_LT(sigma(result, front, 2), 0.01);
}

TEST_F(RectangleCovarianceTest, PlanesOfFarFrontsAreLessCertain) {
  const Rectangle near = exampleFront({0, 0, 1}, 0.4, 0.125, 0, 0, 0);
  const Rectangle far = exampleFront({0, 0, 2}, 0.4, 0.125, 0, 0, 0);
  const std::array<EdgeObservation, 4> edges{kSeen, kSeen, kSeen, kSeen};
  // A tilt changes disparities with 1 / z^2, and a quarter of the pixels doubles the error once more: 2^3 in all, less
  // where the prior of half a radian begins to count.
  const double ratio = sigma(covariance(far, edges), far, 3) / sigma(covariance(near, edges), near, 3);
  EXPECT_GT(ratio, 5);
  EXPECT_LT(ratio, 9);
}

TEST_F(RectangleCovarianceTest, TiltMatchesTheScatterOfFittedPlanes) {
  // Fit planes to disparities whose noise is shared by windows of 15x15 px, as in block matching.
  const Rectangle front = exampleFront({0, 0, 1.3}, 0.4, 0.2, 0, 0, 0);
  const PlaneRegion region = finishRegion(frontRegion(front, frame_.camera));
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.15);
  const cv::Rect box = cv::boundingRect(region.hull);
  double squares = 0;
  constexpr int kTrials = 200;
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (int v = box.y; v + 15 <= box.br().y; v += 15)
      for (int u = box.x; u + 15 <= box.br().x; u += 15) {
        const Eigen::Vector3d row(u + 7, v + 7, 1);
        normal += row * row.transpose();
        right += row * (region.disparity_plane.at(u + 7, v + 7) + noise(random));
      }
    const Eigen::Vector3d fit = normal.ldlt().solve(right);
    const Plane plane = *toPlane({fit.x(), fit.y(), fit.z()}, frame_.camera);
    squares += std::pow(plane.normal.y(), 2);  // a turn about the front's x axis
  }
  const double sigma_x = sigma(covariance(front, {kSeen, kSeen, kSeen, kSeen}), front, 3);
  EXPECT_NEAR(sigma_x, std::sqrt(squares / kTrials), 0.2 * sigma_x);  // 200 trials know a deviation to 5 %, the grid is coarse
}

}  // namespace
}  // namespace cabinet_articulation::core
