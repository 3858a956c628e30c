// SPDX-License-Identifier: BSD-3-Clause
#include "ros/transforms/transform_lookup.h"

#include <gtest/gtest.h>
#include <tf2/exceptions.h>
#include <tf2_eigen/tf2_eigen.h>

#include <vector>

namespace cabinet_articulation {
namespace {

constexpr int kFrames = 200;

ros::Time stampOf(int i) { return ros::Time(100) + ros::Duration(i / 15.0); }

/// A robot that drives about, and a camera on its turning head.
Eigen::Isometry3d baseAt(int i) {
  return Eigen::Translation3d(0.013 * i, 1 / (3.0 + i), 0.1) *
         Eigen::Isometry3d(Eigen::AngleAxisd(0.0137 * i, Eigen::Vector3d(0.1, 0.2, 1).normalized()));
}
Eigen::Isometry3d headAt(int i) {
  return Eigen::Translation3d(0.1, 0.2, 1.1) *
         Eigen::Isometry3d(Eigen::AngleAxisd(-1.5 - 0.0071 * i, Eigen::Vector3d(1, 0.3, 0.05).normalized()));
}

void add(tf2::BufferCore* buffer, int i, const std::string& parent, const std::string& child, const Eigen::Isometry3d& pose) {
  geometry_msgs::TransformStamped transform = tf2::eigenToTransform(pose);
  transform.header.stamp = stampOf(i);
  transform.header.frame_id = parent;
  transform.child_frame_id = child;
  ASSERT_TRUE(buffer->setTransform(transform, "test"));
}

void add(tf2::BufferCore* buffer, int i) {
  add(buffer, i, "/world", "base", baseAt(i));
  add(buffer, i, "base", "/camera", headAt(i));
}

TEST(TransformLookup, IsTheSameToTheLastBitWhetherLaterTransformsAreKnownOrNot) {
  tf2::BufferCore buffer(ros::Duration(3600));
  std::vector<Eigen::Matrix4d> live, raw;
  for (int i = 0; i < kFrames; ++i) {
    add(&buffer, i);
    live.push_back(lookupTransform(buffer, "world", "camera", stampOf(i)).matrix());
    raw.push_back(tf2::transformToEigen(buffer.lookupTransform("world", "camera", stampOf(i))).matrix());
  }
  int differences_of_tf2 = 0;
  for (int i = 0; i < kFrames; ++i) {
    EXPECT_EQ(lookupTransform(buffer, "world", "camera", stampOf(i)).matrix(), live[i]) << i;
    differences_of_tf2 += tf2::transformToEigen(buffer.lookupTransform("world", "camera", stampOf(i))).matrix() != raw[i];
  }
  EXPECT_GT(differences_of_tf2, 0) << "or this test shows nothing";
}

TEST(TransformLookup, IsRightToANanometreAndARigidMotion) {
  tf2::BufferCore buffer(ros::Duration(3600));
  for (int i = 0; i < kFrames; ++i) add(&buffer, i);
  for (int i = 0; i < kFrames; ++i) {
    const Eigen::Isometry3d T = lookupTransform(buffer, "world", "camera", stampOf(i));
    EXPECT_LT((T.matrix() - (baseAt(i) * headAt(i)).matrix()).cwiseAbs().maxCoeff(), 5e-9);
    EXPECT_LT((T.linear() * T.linear().transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  }
}

TEST(TransformLookup, TakesFrameNamesWithAndWithoutALeadingSlash) {
  tf2::BufferCore buffer;
  add(&buffer, 0);
  const Eigen::Matrix4d expected = lookupTransform(buffer, "world", "camera", stampOf(0)).matrix();
  EXPECT_EQ(lookupTransform(buffer, "/world", "/camera", stampOf(0)).matrix(), expected);
  EXPECT_EQ(lookupTransform(buffer, "/elsewhere", "elsewhere", stampOf(0)).matrix(), Eigen::Matrix4d::Identity().eval())
      << "the same frame needs no tf";
  EXPECT_THROW(lookupTransform(buffer, "world", "elsewhere", stampOf(0)), tf2::TransformException);
  EXPECT_THROW(lookupTransform(buffer, "world", "camera", stampOf(9)), tf2::TransformException);
}

}  // namespace
}  // namespace cabinet_articulation
