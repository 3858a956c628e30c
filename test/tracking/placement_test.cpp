// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/size/placement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

const TrackingConfig kConfig;

DetectedRectangle seen(const Rectangle& front) {
  DetectedRectangle detection;
  detection.rectangle = front;
  detection.covariance = Matrix6d::Identity() * 1e-6;
  detection.edge_support = {1, 1, 1, 1};
  return detection;
}

KnownSize sizeOf(const Rectangle& front) { return {{front.width, front.height}, {0.004, 0.3}}; }

/// Position of the middle of an edge.
Eigen::Vector3d middle(const Rectangle& rectangle, int edge) {
  const double half = (edge < 2 ? rectangle.width : rectangle.height) / 2;
  return rectangle.pose * ((edge % 2 == 0 ? -half : half) * Eigen::Vector3d::Unit(edge / 2));
}

TEST(Placement, DescriptionsCarryTheirEdgesAlong) {
  DetectedRectangle original = seen(swung(closedFront(), 0.4));
  original.edge_support = {0.1F, 0.2F, 0.3F, 0.4F};
  for (int k = 0; k < kDescriptions; ++k) {
    const DetectedRectangle other = describe(original, k);
    for (int edge = 0; edge < 4; ++edge) {
      for (int original_edge = 0; original_edge < 4; ++original_edge) {
        const bool same = (middle(other.rectangle, edge) - middle(original.rectangle, original_edge)).norm() < 1e-9;
        EXPECT_EQ(same, other.edge_support[edge] == original.edge_support[original_edge]) << k << ' ' << edge;
      }
    }
  }
}

TEST(Placement, EdgesAreAsCertainAsTheyWereObserved) {
  EXPECT_NEAR(edgeSigma(0, kConfig), kConfig.unseen_edge_sigma, 1e-12);
  EXPECT_NEAR(edgeSigma(0.4, kConfig), std::sqrt(kConfig.unseen_edge_sigma * kConfig.edge_sigma), 1e-12) << "half way";
  EXPECT_NEAR(edgeSigma(0.8, kConfig), kConfig.edge_sigma, 1e-12);
  EXPECT_EQ(edgeSigma(1, kConfig), kConfig.edge_sigma);
}

TEST(Placement, TheObservedEdgeDecides) {
  const Rectangle front = swung(closedFront(), 0.7);
  for (int edge = 0; edge < 4; ++edge) {
    const DetectedRectangle cut = withHiddenEdge(seen(front), static_cast<Edge>(edge), 0.15);
    const Rectangle placed = placeOnObservedEdges(cut, {sizeOf(front).value, {0.002, 0.002}}, nullptr, kConfig).rectangle;
    EXPECT_LT((placed.center() - front.center()).norm(), 1e-4) << edge << ": the hidden edge weighs 10^-4";
    EXPECT_NEAR(placed.width, front.width, 1e-4);
    EXPECT_NEAR(placed.height, front.height, 1e-4);
  }
}

TEST(Placement, TwoAgreeingEdgesStayWhereTheyWereSeen) {
  DetectedRectangle detection = seen(closedFront());
  detection.rectangle.width += 0.01;
  const DetectedRectangle placed = placeOnObservedEdges(detection, sizeOf(closedFront()), nullptr, kConfig);
  EXPECT_LT((placed.rectangle.center() - detection.rectangle.center()).norm(), 1e-12);
  EXPECT_GT(placed.rectangle.width, closedFront().width);
  EXPECT_LT(placed.rectangle.width, detection.rectangle.width) << "between what is known and what was measured";
  const double edges = kConfig.edge_sigma * kConfig.edge_sigma / 2;  // of the mean of two edges
  EXPECT_NEAR(placed.covariance(0, 0), edges, 1e-12);
}

TEST(Placement, ContradictingEdgesDoNotLookLikeMotion) {
  const Rectangle front = closedFront();
  const KnownPlace place{front, Eigen::Matrix3d::Zero()};
  DetectedRectangle merged = seen(front);  // 12 cm too wide at +x, and sure of it
  merged.rectangle.pose.translate(Eigen::Vector3d(0.06, 0, 0));
  merged.rectangle.width += 0.12;
  const DetectedRectangle placed = placeOnObservedEdges(merged, sizeOf(front), &place, kConfig);
  const double error = (placed.rectangle.center() - front.center()).norm();
  EXPECT_LT(error, 0.06 / 4);
  const Eigen::Vector3d x = front.pose.linear().col(0);
  EXPECT_GT(x.dot(placed.covariance.topLeftCorner<3, 3>() * x), error * error) << "and the covariance says so";
}

TEST(Placement, UnseenEdgesStayWhereTheyWere) {
  const Rectangle front = closedFront();
  const KnownPlace place{front, Eigen::Matrix3d::Zero()};
  DetectedRectangle slid = seen(pulled(front, 0.1));
  slid.rectangle.pose.translate(Eigen::Vector3d(0.03, 0, 0));
  slid.edge_support = {0, 0, 1, 1};
  const DetectedRectangle placed = placeOnObservedEdges(slid, sizeOf(front), &place, kConfig);
  const Eigen::Vector3d error = placed.rectangle.center() - pulled(front, 0.1).center();
  EXPECT_LT(error.norm(), 0.003) << "a tenth of the slide; the motion along the normal was seen";
  EXPECT_GT(placed.covariance(0, 0), 0.02 * 0.02);
  EXPECT_LT(placed.covariance(1, 1), 0.002 * 0.002);
}

TEST(Placement, AnUncertainPlaceHoldsNothingBack) {
  const Rectangle front = closedFront();
  DetectedRectangle half = withHiddenEdge(seen(front), kEdgeMinusX, 0.1);
  Rectangle wrong = front;
  wrong.pose.translate(Eigen::Vector3d(-0.1, 0, 0));
  const KnownPlace place{wrong, Eigen::Matrix3d::Identity() * 0.15 * 0.15};
  const KnownSize size{sizeOf(front).value, {0.05, 0.05}};
  const Rectangle placed = placeOnObservedEdges(half, size, &place, kConfig).rectangle;
  EXPECT_LT((placed.center() - front.center()).norm(), 0.005) << "2.5 cm of the size against 15 cm";
}

TEST(Placement, ASeenEdgeIsNotHeldBack) {
  const Rectangle front = closedFront();
  const KnownPlace place{front, Eigen::Matrix3d::Zero()};
  DetectedRectangle moved = seen(front);
  moved.rectangle.pose.translate(Eigen::Vector3d(0.03, 0, 0));
  moved.edge_support = {0, 1, 1, 1};
  const KnownSize size{sizeOf(front).value, {0.002, 0.002}};
  const Rectangle placed = placeOnObservedEdges(moved, size, &place, kConfig).rectangle;
  EXPECT_LT((placed.center() - moved.rectangle.center()).norm(), 0.001) << "2 mm against 30 mm: a hundredth";
}

TEST(Placement, AnUncertainSizeMakesAnUncertainPlace) {
  const DetectedRectangle cut_x = withHiddenEdge(seen(closedFront()), kEdgePlusX, 0.1);
  const DetectedRectangle cut_y = withHiddenEdge(seen(closedFront()), kEdgePlusY, 0.1);
  const auto sigma = [](const DetectedRectangle& cut, int axis) {
    const Eigen::Vector3d direction = cut.rectangle.pose.linear().col(axis);
    const DetectedRectangle placed = placeOnObservedEdges(cut, sizeOf(closedFront()), nullptr, kConfig);
    return std::sqrt(direction.dot(placed.covariance.topLeftCorner<3, 3>() * direction));
  };
  EXPECT_NEAR(sigma(cut_x, 0), std::hypot(kConfig.edge_sigma, 0.002), 1e-5) << "the edge, and half of the size";
  EXPECT_NEAR(sigma(cut_y, 1), 0.5 / std::hypot(1 / 0.2, 1 / 0.3), 1e-3) << "nothing but guesses";
}

TEST(Placement, NormalDirectionOfTheCovarianceIsKept) {
  DetectedRectangle cut = withHiddenEdge(seen(swung(closedFront(), 0.5)), kEdgePlusX, 0.1);
  const DetectedRectangle placed = placeOnObservedEdges(cut, sizeOf(closedFront()), nullptr, kConfig);
  const Eigen::Vector3d normal = cut.rectangle.normal();
  EXPECT_NEAR(normal.dot(placed.covariance.topLeftCorner<3, 3>() * normal), 1e-6, 1e-15);
  EXPECT_TRUE(placed.covariance.isApprox(placed.covariance.transpose()));
}

}  // namespace
}  // namespace cabinet_articulation::core
