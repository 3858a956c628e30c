// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/tracking/placement.h"

#include <gtest/gtest.h>

#include "tracking/synthetic_fronts.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kMinSupport = 0.5;

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

TEST(Placement, TheObservedEdgeDecides) {
  const Rectangle front = swung(closedFront(), 0.7);
  for (int edge = 0; edge < 4; ++edge) {
    const DetectedRectangle cut = withHiddenEdge(seen(front), static_cast<Edge>(edge), 0.15);
    const Rectangle placed = placeOnObservedEdges(cut, sizeOf(front), nullptr, kMinSupport).rectangle;
    EXPECT_LT((placed.center() - front.center()).norm(), 1e-9) << edge;
    EXPECT_NEAR(placed.width, front.width, 1e-12);
    EXPECT_NEAR(placed.height, front.height, 1e-12);
  }
}

TEST(Placement, TwoAgreeingEdgesStayWhereTheyWereSeen) {
  DetectedRectangle detection = seen(closedFront());
  detection.rectangle.width += 0.01;
  const DetectedRectangle placed = placeOnObservedEdges(detection, sizeOf(closedFront()), nullptr, kMinSupport);
  EXPECT_LT((placed.rectangle.center() - detection.rectangle.center()).norm(), 1e-12);
  EXPECT_EQ(placed.rectangle.width, detection.rectangle.width);
  EXPECT_TRUE(placed.covariance.isApprox(detection.covariance));
}

TEST(Placement, ContradictingEdgesDoNotLookLikeMotion) {
  const Rectangle front = closedFront();
  DetectedRectangle merged = seen(front);  // 12 cm too wide at +x, and sure of it
  merged.rectangle.pose.translate(Eigen::Vector3d(0.06, 0, 0));
  merged.rectangle.width += 0.12;
  const DetectedRectangle placed = placeOnObservedEdges(merged, sizeOf(front), &front, kMinSupport);
  EXPECT_LT((placed.rectangle.center() - front.center()).norm(), 1e-9);
  const Eigen::Vector3d x = front.pose.linear().col(0);
  EXPECT_NEAR(x.dot(placed.covariance.topLeftCorner<3, 3>() * x), 0.06 * 0.06 / 3, 1e-9) << "uniform over +-6 cm";
}

TEST(Placement, UnseenEdgesStayWhereTheyWere) {
  const Rectangle front = closedFront();
  DetectedRectangle slid = seen(pulled(front, 0.1));
  slid.rectangle.pose.translate(Eigen::Vector3d(0.03, 0, 0));
  slid.edge_support = {0, 0, 1, 1};
  const Rectangle placed = placeOnObservedEdges(slid, sizeOf(front), &front, kMinSupport).rectangle;
  EXPECT_LT((placed.center() - pulled(front, 0.1).center()).norm(), 1e-9) << "the motion along the normal was seen";
}

TEST(Placement, AnUncertainSizeMakesAnUncertainPlace) {
  const DetectedRectangle cut_x = withHiddenEdge(seen(closedFront()), kEdgePlusX, 0.1);
  const DetectedRectangle cut_y = withHiddenEdge(seen(closedFront()), kEdgePlusY, 0.1);
  const auto variance = [](const DetectedRectangle& cut, int axis) {
    const Eigen::Vector3d direction = cut.rectangle.pose.linear().col(axis);
    const DetectedRectangle placed = placeOnObservedEdges(cut, sizeOf(closedFront()), nullptr, kMinSupport);
    return direction.dot(placed.covariance.topLeftCorner<3, 3>() * direction);
  };
  EXPECT_NEAR(variance(cut_x, 0), 0.005 * 0.005 + 0.002 * 0.002, 1e-12) << "the edge, and half of the size";
  EXPECT_NEAR(variance(cut_y, 1), 0.005 * 0.005 + 0.15 * 0.15, 1e-12);
}

TEST(Placement, NormalDirectionOfTheCovarianceIsKept) {
  DetectedRectangle cut = withHiddenEdge(seen(swung(closedFront(), 0.5)), kEdgePlusX, 0.1);
  const DetectedRectangle placed = placeOnObservedEdges(cut, sizeOf(closedFront()), nullptr, kMinSupport);
  const Eigen::Vector3d normal = cut.rectangle.normal();
  EXPECT_NEAR(normal.dot(placed.covariance.topLeftCorner<3, 3>() * normal), 1e-6, 1e-15);
  EXPECT_TRUE(placed.covariance.isApprox(placed.covariance.transpose()));
}

}  // namespace
}  // namespace cabinet_articulation::core
