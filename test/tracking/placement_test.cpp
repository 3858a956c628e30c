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
    const DetectedRectangle aligned = alignDescription(other, original.rectangle);
    EXPECT_EQ(aligned.edge_support, original.edge_support) << k;
  }
}

TEST(Placement, TheObservedEdgeDecides) {
  const Rectangle front = swung(closedFront(), 0.7);
  for (int edge = 0; edge < 4; ++edge) {
    const DetectedRectangle cut = withHiddenEdge(seen(front), static_cast<Edge>(edge), 0.15);
    const Rectangle placed = placeOnObservedEdges(cut, {front.width, front.height}, nullptr, kMinSupport).rectangle;
    EXPECT_LT((placed.center() - front.center()).norm(), 1e-9) << edge;
    EXPECT_EQ(placed.width, front.width);
    EXPECT_EQ(placed.height, front.height);
  }
}

TEST(Placement, TwoAgreeingEdgesShareTheError) {
  DetectedRectangle detection = seen(closedFront());
  detection.rectangle.width += 0.01;
  const Rectangle middle_kept = placeOnObservedEdges(detection, {0.395, 0.58}, nullptr, kMinSupport).rectangle;
  EXPECT_LT((middle_kept.center() - detection.rectangle.center()).norm(), 1e-12);
  detection.edge_support = {0.5F, 1, 1, 1};
  const Eigen::Vector3d shift =
      placeOnObservedEdges(detection, {0.395, 0.58}, nullptr, kMinSupport).rectangle.center() - detection.rectangle.center();
  EXPECT_NEAR(shift.dot(detection.rectangle.pose.linear().col(0)), 0.005 / 3, 1e-9);
}

TEST(Placement, ContradictingEdgesDoNotLookLikeMotion) {
  const Rectangle front = closedFront();
  DetectedRectangle merged = seen(front);  // 12 cm too wide at +x, and sure of it
  merged.rectangle.pose.translate(Eigen::Vector3d(0.06, 0, 0));
  merged.rectangle.width += 0.12;
  const DetectedRectangle placed = placeOnObservedEdges(merged, {front.width, front.height}, &front, kMinSupport);
  EXPECT_LT((placed.rectangle.center() - front.center()).norm(), 1e-9);
  const Eigen::Vector3d x = front.pose.linear().col(0);
  EXPECT_NEAR(x.dot(placed.covariance.topLeftCorner<3, 3>() * x), 0.06 * 0.06 / 3, 1e-9) << "uniform over +-6 cm";
}

TEST(Placement, UnseenEdgesStayWhereTheyWere) {
  const Rectangle front = closedFront();
  DetectedRectangle slid = seen(pulled(front, 0.1));
  slid.rectangle.pose.translate(Eigen::Vector3d(0.03, 0, 0));
  slid.edge_support = {0, 0, 1, 1};
  const Rectangle placed = placeOnObservedEdges(slid, {front.width, front.height}, &front, kMinSupport).rectangle;
  EXPECT_LT((placed.center() - pulled(front, 0.1).center()).norm(), 1e-9) << "the motion along the normal was seen";
}

TEST(Placement, NormalDirectionOfTheCovarianceIsKept) {
  DetectedRectangle cut = withHiddenEdge(seen(swung(closedFront(), 0.5)), kEdgePlusX, 0.1);
  const DetectedRectangle placed = placeOnObservedEdges(cut, {0.395, 0.58}, nullptr, kMinSupport);
  const Eigen::Vector3d normal = cut.rectangle.normal();
  EXPECT_NEAR(normal.dot(placed.covariance.topLeftCorner<3, 3>() * normal), 1e-6, 1e-15);
  EXPECT_TRUE(placed.covariance.isApprox(placed.covariance.transpose()));
}

}  // namespace
}  // namespace cabinet_articulation::core
