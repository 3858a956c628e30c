// SPDX-License-Identifier: BSD-3-Clause
#include "ros/messages/plane_messages.h"

#include <gtest/gtest.h>

#include <set>

#include "cabinet_articulation/ros/image_conversions.h"
#include "support/ros_messages.h"

namespace cabinet_articulation {
namespace {

using test::errorOf;
using test::exampleHeader;

std::vector<core::PlaneRegion> exampleRegions(size_t count) {
  core::PlaneRegion region;
  region.plane = {Eigen::Vector3d(0.6, 0, -0.8), 1.25};
  region.mask = cv::Mat1b(24, 32, std::uint8_t{core::kFree});
  return std::vector<core::PlaneRegion>(count, region);
}

TEST(PlaneMessages, AMaskComesBackWhenTheLastHolderLetsGo) {
  PlaneMessages messages;
  PlaneArrayPtr first = messages.make(exampleRegions(1), exampleHeader());
  const void* const memory = first->planes[0].mask.data.data();
  PlaneArrayConstPtr subscriber = first;
  first.reset();
  EXPECT_NE(messages.make(exampleRegions(1), exampleHeader())->planes[0].mask.data.data(), memory) << "somebody reads it";
  subscriber.reset();
  EXPECT_EQ(messages.make(exampleRegions(1), exampleHeader())->planes[0].mask.data.data(), memory);
}

TEST(PlaneMessages, AFrameWithFewRegionsKeepsTheMemoryForOneWithMany) {
  PlaneMessages messages;
  std::set<const void*> memory;
  PlaneArrayPtr message = messages.make(exampleRegions(3), exampleHeader());
  for (const Plane& plane : message->planes) memory.insert(plane.mask.data.data());
  message.reset();
  messages.make(exampleRegions(1), exampleHeader());
  message = messages.make(exampleRegions(3), exampleHeader());
  for (const Plane& plane : message->planes) EXPECT_EQ(memory.count(plane.mask.data.data()), 1U);
}

TEST(PlaneMessages, AMessageMayOutliveItsMaker) {
  PlaneArrayConstPtr message = PlaneMessages().make(exampleRegions(1), exampleHeader());
  EXPECT_EQ(message->planes[0].mask.data.size(), 24U * 32U);
  message.reset();
}

TEST(PlaneConversion, MaskIsAViewAndEveryFieldComesBack) {
  core::PlaneRegion region;
  region.plane = {Eigen::Vector3d(0.6, 0, -0.8), 1.25};
  region.disparity_plane = {0.1, 0.2, 30};
  region.inliers = 55;
  region.hull = {{1, 2}, {30.5F, 2}, {10, 20}};
  region.mask = cv::Mat1b(240, 320, std::uint8_t{core::kFree});
  region.mask(3, 4) = core::kInPlane;
  const PlaneArray message = *PlaneMessages().make({region}, exampleHeader());
  EXPECT_EQ(message.planes[0].mask.encoding, "mono8");
  EXPECT_EQ(message.planes[0].mask.header.stamp, exampleHeader().stamp);
  const core::PlaneRegion back = fromMessage(message).at(0);
  EXPECT_EQ(back.mask.data, message.planes[0].mask.data.data());
  EXPECT_EQ(cv::countNonZero(back.mask != region.mask), 0);
  EXPECT_EQ(back.plane.normal, region.plane.normal);
  EXPECT_EQ(back.plane.offset, region.plane.offset);
  EXPECT_EQ(back.disparity_plane.a, 0.1);
  EXPECT_EQ(back.disparity_plane.b, 0.2);
  EXPECT_EQ(back.disparity_plane.c, 30);
  EXPECT_EQ(back.inliers, 55);
  EXPECT_EQ(back.hull, region.hull);
}

TEST(PlaneConversion, MaskThatIsPartOfALargerMatrixIsPackedTightly) {
  cv::Mat1b large(10, 20, std::uint8_t{0});
  core::PlaneRegion region;
  region.mask = large(cv::Rect(5, 2, 4, 3));
  region.mask(1, 1) = core::kInPlane;
  Plane message;
  toMessage(region, exampleHeader(), &message);
  EXPECT_EQ(message.mask.step, 4u);
  EXPECT_EQ(message.mask.data[1 * 4 + 1], core::kInPlane);
}

TEST(PlaneConversion, NamesThePlaneWithABrokenMask) {
  PlaneArray message = *PlaneMessages().make(exampleRegions(2), exampleHeader());
  message.planes[1].mask.data.resize(3);
  EXPECT_EQ(errorOf([&] { fromMessage(message); }), "planes[1]: mask: holds 3 bytes in rows of 32, too few for 32x24 pixels");
}

TEST(PlaneConversion, TheBendComesBack) {
  core::BendVector bend = core::BendVector::LinSpaced(-0.3, 0.4);
  PlaneArray message;
  EXPECT_TRUE(bendOf(message).isZero(0));
  message.bend = toMessage(bend);
  EXPECT_EQ(bendOf(message), bend) << "to the bit";
  EXPECT_TRUE(toMessage(core::BendVector::Zero()).empty());
}

TEST(PlaneConversion, ABendThatIsNoneIsRefusedInWords) {
  PlaneArray message;
  message.bend.resize(11);
  EXPECT_EQ(errorOf([&] { bendOf(message); }), "bend has 11 terms, expected 12, or none");
  message.bend.assign(12, std::nan(""));
  EXPECT_EQ(errorOf([&] { bendOf(message); }), "bend is nan, expected -20 to 20 px");
}

}  // namespace
}  // namespace cabinet_articulation
