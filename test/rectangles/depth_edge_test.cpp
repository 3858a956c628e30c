// SPDX-License-Identifier: BSD-3-Clause
#include "rectangles/edges/depth_edge.h"

#include <gtest/gtest.h>

#include <random>

#include "front_scene.h"
#include "rectangles/edges/side_face.h"

namespace cabinet_articulation::core {
namespace {

constexpr double kThickness = 0.018;  // [m] of a board
constexpr double kNoise = 0.15;       // [px] of disparities

/// A board before a wall, as a depth camera sees it.
class DepthEdgeTest : public testing::Test {
 protected:
  explicit DepthEdgeTest(double yaw = 0.8) : front_(exampleFront({0, 0, kFront}, 0.4, 0.5, yaw, 0, 0)) {
    render();
    region_ = frontRegion(front_, camera_);
    label();
  }

  /// [px] outward from the true edge; negative inside the front.
  double beyond(Edge edge, double u, double v) const {
    const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, camera_.project(front_.center()));
    const ImageEdge image = *imageEdge(chart, chart.fromSpace(front_), edge);
    return image.outward.dot(Eigen::Vector2d(u, v) - image.a);
  }

  /// Takes the depth of a share of the pixels from `begin` to `end` [px] beyond the edge.
  void lose(Edge edge, double begin, double end, double share) {
    std::mt19937 random(2);
    std::bernoulli_distribution is_lost(share);
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) {
        const double place = beyond(edge, u, v);
        if (place >= begin && place < end && is_lost(random)) frame_.disparity(v, u) = 0;
      }
    label();
  }

  /// A recess along a share of the edge, about its middle, from there `reach` inwards and `depth` deep [m].
  void recess(Edge edge, double reach, double share, double depth) {
    const Eigen::Isometry3d to_front = front_.pose.inverse();
    const int axis = edgeAxis(edge);
    const double side = edge == kEdgePlusX || edge == kEdgePlusY ? 1 : -1;
    const Eigen::Vector2d half(front_.width / 2, front_.height / 2);
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) {
        const Eigen::Vector3d p = to_front * *front_.plane().intersect(camera_.ray(u, v));
        const double inside = half[axis] - side * p[axis];
        if (inside < 0 || inside > reach || std::abs(p[1 - axis]) > share * half[1 - axis]) continue;
        frame_.disparity(v, u) += static_cast<float>(camera_.disparity(kFront + depth) - camera_.disparity(kFront));
      }
    label();
  }

  /// [m] from the true edge to where depth says it is, from a rectangle that is `wrong` [m] too large.
  std::optional<double> error(Edge edge, double wrong) const {
    const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, camera_.project(front_.center()));
    PlaneRectangle rectangle = chart.fromSpace(front_);
    rectangle.moveEdge(edge, wrong);
    const ImageEdge image = *imageEdge(chart, rectangle, edge);
    const SideFace face = sideFace(chart, camera_, region_.disparity_plane, rectangle, edge);
    const auto place = DepthEdge(frame_, region_, image, face).whole();
    if (!place) return std::nullopt;
    return wrong + place->offset * image.metres_per_pixel;
  }

  /// What lies beyond the edge is a surface that comes nearer by `slope` [px/px].
  void neighbour(Edge edge, double slope) {
    render();
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0, kNoise);
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u)
        if (const double off = beyond(edge, u, v); off > 0)
          frame_.disparity(v, u) = static_cast<float>(region_.disparity_plane.at(u, v) + slope * off + noise(random));
    label();
  }

  /// [m] from the true edge to the crease found from a rectangle that is `wrong` [m] too large.
  std::optional<double> creaseError(Edge edge, double wrong) const {
    const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, camera_.project(front_.center()));
    PlaneRectangle rectangle = chart.fromSpace(front_);
    rectangle.moveEdge(edge, wrong);
    const ImageEdge image = *imageEdge(chart, rectangle, edge);
    const auto place = DepthEdge(frame_, region_, image, {}).crease(kSlope);
    if (!place) return std::nullopt;
    return wrong + *place * image.metres_per_pixel;
  }

  /// What lies within the rectangle's frame between `back` and 0 [m] along the normal.
  void render() {
    frame_.camera = camera_;
    frame_.disparity = cv::Mat1f(camera_.height, camera_.width, static_cast<float>(camera_.disparity(kWall)));
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, kNoise);
    const Eigen::Isometry3d to_front = front_.pose.inverse();
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) {
        double z = kWall;
        const Eigen::Vector3d ray = camera_.ray(u, v);
        const Eigen::Vector3d direction = to_front.linear() * ray, start = to_front.translation();
        const double face = -start.z() / direction.z();
        if (isInside(start + face * direction, 1e-9)) z = std::min(z, face * ray.z());
        for (const double side : {-front_.width / 2, front_.width / 2}) {
          const double t = (side - start.x()) / direction.x();
          const Eigen::Vector3d p = start + t * direction;
          if (t > 0 && p.z() < 0 && p.z() > -kThickness && std::abs(p.y()) < front_.height / 2) z = std::min(z, t * ray.z());
        }
        frame_.disparity(v, u) = static_cast<float>(camera_.disparity(z) + noise(random));
      }
  }

  bool isInside(const Eigen::Vector3d& p, double off) const {
    return std::abs(p.z()) <= off && std::abs(p.x()) < front_.width / 2 && std::abs(p.y()) < front_.height / 2;
  }

  /// As the planes stage does: what lies within 1 px of the plane belongs to it.
  void label() {
    for (int v = 0; v < camera_.height; ++v)
      for (int u = 0; u < camera_.width; ++u) {
        const double off = frame_.disparity(v, u) - region_.disparity_plane.at(u, v);
        if (!isValidDisparity(frame_.disparity(v, u)))
          region_.mask(v, u) = kUnknown;
        else
          region_.mask(v, u) = off > 1 ? kOccluded : off < -1 ? kFree : kInPlane;
      }
  }

  static constexpr double kFront = 1.8, kWall = 3;  // [m]
  static constexpr double kSlope = 0.03;            // [px/px]
  const StereoCamera camera_ = exampleCamera();
  const Rectangle front_;
  DepthFrame frame_;
  PlaneRegion region_;
};

class DepthEdgeHeadOnTest : public DepthEdgeTest {
 protected:
  DepthEdgeHeadOnTest() : DepthEdgeTest(0) {}
};

TEST_F(DepthEdgeHeadOnTest, FindsEdgesWithoutAFace) {
  for (const Edge edge : kEdges)
    for (const double wrong : {-0.012, 0.0, 0.012}) {
      const auto off = error(edge, wrong);
      ASSERT_TRUE(off) << "edge " << edge << ", wrong by " << wrong;
      EXPECT_LT(std::abs(*off), 0.0015) <<  // half a pixel
          "edge " << edge << ", wrong by " << wrong;
    }
}

TEST_F(DepthEdgeHeadOnTest, PixelsThatAreLostOnBothSidesDoNotShortenAFront) {
  for (const Edge edge : kEdges) lose(edge, -2, 2, 0.6);
  for (const Edge edge : kEdges) {
    const auto off = error(edge, 0);
    ASSERT_TRUE(off) << edge;
    EXPECT_LT(std::abs(*off), 0.0015) << "half a pixel, edge " << edge;
  }
}

TEST_F(DepthEdgeHeadOnTest, AShadowBeyondAnEdgeIsNotTheFronts) {
  lose(kEdgePlusX, -2, 0, 0.6);
  lose(kEdgePlusX, 0, 9, 1);
  const auto off = error(kEdgePlusX, 0);
  ASSERT_TRUE(off);
  EXPECT_LT(std::abs(*off), 0.0015);
}

TEST_F(DepthEdgeHeadOnTest, ARecessedPullDoesNotMoveItsEdge) {
  for (const Edge edge : kEdges) recess(edge, 0.05, 0.2, 0.08);
  for (const Edge edge : kEdges) {
    const auto off = error(edge, 0);
    ASSERT_TRUE(off) << edge;
    EXPECT_LT(std::abs(*off), 0.0015) << "half a pixel, edge " << edge;
  }
}

TEST_F(DepthEdgeHeadOnTest, SingleRowsAndColumnsWithoutADepthAreNoEnd) {
  for (int v = 0; v < camera_.height; v += 4) frame_.disparity.row(v) = 0;
  for (int u = 1; u < camera_.width; u += 4) frame_.disparity.col(u) = 0;
  label();
  for (const Edge edge : kEdges) {
    const auto off = error(edge, 0);
    ASSERT_TRUE(off) << edge;
    EXPECT_LT(std::abs(*off), 0.0045) << "1.5 px, where the edge itself has no depth; edge " << edge;
  }
}

TEST_F(DepthEdgeTest, DoesNotTakeTheSideOfABoardForTheFront) {
  int faces = 0;
  for (const Edge edge : {kEdgeMinusX, kEdgePlusX}) {
    const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, camera_.project(front_.center()));
    const bool has_face = sideFace(chart, camera_, region_.disparity_plane, chart.fromSpace(front_), edge).slope < 0;
    faces += has_face;
    for (const double wrong : {0.0, 0.02}) {
      const auto off = error(edge, wrong);
      ASSERT_TRUE(off) << "edge " << edge << ", wrong by " << wrong;
      EXPECT_LT(std::abs(*off), 0.002) << "edge " << edge << ", wrong by " << wrong;  // half a pixel, and noise
    }
  }
  EXPECT_EQ(faces, 1);
}

TEST_F(DepthEdgeHeadOnTest, SaysNothingOfAnEdgeThatSomethingHides) {
  const Eigen::Vector2d edge = camera_.project(front_.pose * Eigen::Vector3d(front_.width / 2, 0, 0));
  const Eigen::Vector2d other = camera_.project(front_.pose * Eigen::Vector3d(-front_.width / 2, 0, 0));
  const int begin = static_cast<int>(std::max(edge.x(), other.x()));
  cv::Rect hand(begin, 0, 30, camera_.height);
  frame_.disparity(hand).setTo(static_cast<float>(camera_.disparity(1)));
  label();
  const Edge hidden = edge.x() > other.x() ? kEdgePlusX : kEdgeMinusX;
  EXPECT_FALSE(error(hidden, 0));
}

TEST_F(DepthEdgeHeadOnTest, SaysNothingOfASurfaceThatGoesOn) {
  frame_.disparity.setTo(static_cast<float>(camera_.disparity(front_.center().z())));
  label();
  for (const Edge edge : kEdges) EXPECT_FALSE(error(edge, 0));
}

TEST_F(DepthEdgeHeadOnTest, SaysNothingOfAnEdgeFarInside) {
  for (const Edge edge : kEdges) EXPECT_FALSE(error(edge, 0.03)) << "11 px";
}

TEST_F(DepthEdgeHeadOnTest, FindsWhereANeighbourComesNearer) {
  for (const Edge edge : kEdges)
    for (const double wrong : {-0.02, 0.0, 0.03}) {
      neighbour(edge, kSlope);
      const auto off = creaseError(edge, wrong);
      ASSERT_TRUE(off) << "edge " << edge << ", wrong by " << wrong;
      EXPECT_LT(std::abs(*off), 0.006) << "2 px, edge " << edge << ", wrong by " << wrong;
    }
}

TEST_F(DepthEdgeHeadOnTest, FindsANeighbourAllTheSameWhereTheSensorBends) {
  neighbour(kEdgePlusX, kSlope);
  const double middle = camera_.width / 2.0;
  for (int v = 0; v < camera_.height; ++v)
    for (int u = 0; u < camera_.width; ++u)
      frame_.disparity(v, u) += static_cast<float>(0.2 * std::pow((u - middle) / middle, 2));
  label();
  const auto off = creaseError(kEdgePlusX, 0);
  ASSERT_TRUE(off);
  EXPECT_LT(std::abs(*off), 0.006) << "2 px; the planes' own line is 0.2 px / 0.03 away, that is 7 px";
}

TEST_F(DepthEdgeHeadOnTest, FindsNoCreaseInOneSurface) {
  frame_.disparity.setTo(static_cast<float>(camera_.disparity(kFront)));
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, kNoise);
  for (float& disparity : frame_.disparity) disparity += static_cast<float>(noise(random));
  label();
  for (const Edge edge : kEdges) EXPECT_FALSE(creaseError(edge, 0)) << edge;
}

TEST_F(DepthEdgeHeadOnTest, HalvesTellATurn) {
  const PlaneChart chart = *PlaneChart::at(front_.plane(), camera_, camera_.project(front_.center()));
  PlaneRectangle rectangle = chart.fromSpace(front_);
  rectangle.angle += 0.02;
  for (const Edge edge : kEdges) {
    const ImageEdge image = *imageEdge(chart, rectangle, edge);
    const DepthEdge depth(frame_, region_, image, {});
    const auto first = depth.half(0), second = depth.half(1);
    ASSERT_TRUE(first && second) << edge;
    // Half an edge's length lies between the middles of its halves.
    const double length = (image.b - image.a).norm();
    EXPECT_NEAR(std::abs(second->offset - first->offset), 0.02 * length / 2, 0.6) << edge;
  }
}

TEST_F(DepthEdgeHeadOnTest, SaysNothingWithoutDepth) {
  frame_.disparity.setTo(0);
  for (const Edge edge : kEdges) EXPECT_FALSE(error(edge, 0));
}

}  // namespace
}  // namespace cabinet_articulation::core
