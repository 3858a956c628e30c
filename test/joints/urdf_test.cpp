// SPDX-License-Identifier: BSD-3-Clause
#include "cabinet_articulation/joints/urdf.h"

#include <gmock/gmock.h>
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "support/models.h"
#include "support/throws_saying.h"

namespace cabinet_articulation::core {
namespace {

using test::ThrowsSaying;
using testing::HasSubstr;

constexpr double kPrecision = 1e-5;  // URDF is written with six digits

Eigen::Isometry3d toIsometry(const urdf::Pose& pose) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::Quaterniond(pose.rotation.w, pose.rotation.x, pose.rotation.y, pose.rotation.z).toRotationMatrix();
  T.translation() = Eigen::Vector3d(pose.position.x, pose.position.y, pose.position.z);
  return T;
}

/// Where URDF puts a link when its joint is at q.
Eigen::Isometry3d linkPose(const urdf::ModelInterface& description, const std::string& name, double q) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  for (auto link = description.getLink(name); link->parent_joint; link = link->getParent()) {
    const urdf::Joint& joint = *link->parent_joint;
    Eigen::Isometry3d T = toIsometry(joint.parent_to_joint_origin_transform);
    const Eigen::Vector3d axis(joint.axis.x, joint.axis.y, joint.axis.z);
    if (joint.type == urdf::Joint::PRISMATIC) T.translate(q * axis);
    if (joint.type == urdf::Joint::REVOLUTE) T.rotate(Eigen::AngleAxisd(q, axis));
    pose = T * pose;
  }
  return pose;
}

urdf::ModelInterfaceSharedPtr parse(const std::vector<LearnedModel>& models) {
  return urdf::parseURDF(toUrdf(models, "odom", "cabinet"));
}

TEST(Urdf, FrontMovesAsTheModelPredicts) {
  const auto description = parse({test::doorModel(), test::drawerModel()});
  ASSERT_TRUE(description);
  EXPECT_EQ(description->getRoot()->name, "odom");
  for (const LearnedModel& model : {test::doorModel(), test::drawerModel()})
    for (const double q : {-0.1, 0.0, 0.25, 1.0}) {
      const Eigen::Isometry3d pose = linkPose(*description, "cabinet_" + std::to_string(model.id) + "_front", q);
      EXPECT_TRUE(pose.isApprox(model.predict(q), kPrecision)) << model.id << " at " << q;
    }
}

TEST(Urdf, LimitsAreWhatWasSeen) {
  const auto description = parse({test::doorModel(), test::drawerModel()});
  const auto door = description->getJoint("cabinet_3_joint"), drawer = description->getJoint("cabinet_4_joint");
  ASSERT_TRUE(door && door->limits && drawer && drawer->limits);
  EXPECT_EQ(door->type, urdf::Joint::REVOLUTE);
  EXPECT_EQ(drawer->type, urdf::Joint::PRISMATIC);
  EXPECT_NEAR(door->limits->lower, 0, kPrecision);
  EXPECT_NEAR(door->limits->upper, 1.2, kPrecision);
  EXPECT_NEAR(drawer->limits->upper, 0.3, kPrecision);
  EXPECT_GT(door->limits->effort, 0);
  EXPECT_GT(door->limits->velocity, 0);
}

TEST(Urdf, PanelHasTheFrontsSizeAndLiesBehindItsSurface) {
  const LearnedModel door = test::doorModel();
  const auto link = parse({door})->getLink("cabinet_3_front");
  ASSERT_TRUE(link && link->visual && link->collision && link->inertial);
  const auto visual = std::dynamic_pointer_cast<urdf::Box>(link->visual->geometry);
  const auto collision = std::dynamic_pointer_cast<urdf::Box>(link->collision->geometry);
  ASSERT_TRUE(visual && collision);
  EXPECT_NEAR(visual->dim.x, door.width, kPrecision);
  EXPECT_NEAR(visual->dim.y, door.height, kPrecision);
  EXPECT_NEAR(collision->dim.x, door.width, kPrecision);
  EXPECT_NEAR(link->visual->origin.position.z, -visual->dim.z / 2, kPrecision) << "its surface is the front";
  // A wooden door of 40 x 60 cm weighs a few kilograms. Every principal moment is less than the sum of the others.
  const urdf::Inertial& inertial = *link->inertial;
  EXPECT_GT(inertial.mass, 2);
  EXPECT_LT(inertial.mass, 6);
  EXPECT_GT(inertial.ixx + inertial.iyy, inertial.izz);
  EXPECT_GT(inertial.iyy + inertial.izz, inertial.ixx);
  EXPECT_GT(inertial.izz + inertial.ixx, inertial.iyy);
  EXPECT_NEAR(inertial.izz, inertial.mass / 12 * (0.4 * 0.4 + 0.6 * 0.6), 1e-4);
}

TEST(Urdf, RefusesWhatIsNoJointInUrdf) {
  EXPECT_THAT([] { parse({test::restingModel()}); }, ThrowsSaying<ModelError>(HasSubstr("has not moved enough yet")));
  EXPECT_THAT([] { parse({test::garageModel()}); },
              ThrowsSaying<ModelError>(HasSubstr("URDF has only prismatic and rotational")));
  EXPECT_FALSE(hasUrdf(test::garageModel()));
  EXPECT_TRUE(hasUrdf(test::doorModel()));
}

TEST(Urdf, NamesAreWhatXmlCanHold) {
  const std::vector<LearnedModel> door{test::doorModel()};
  const auto rootOf = [&](const std::string& frame) { return urdf::parseURDF(toUrdf(door, frame, "cabinet"))->getRoot()->name; };
  for (const std::string frame : {"a<b>&\"'c", "k\u00fcche", "\U0001F6AA"}) EXPECT_EQ(rootOf(frame), frame);
  for (const char* const frame : {"x\x01y", "x\x1fy", "x\xffy", "x\xed\xa0\x80y", "x\xef\xbf\xbey"})
    EXPECT_THAT([&] { toUrdf(door, frame, "cabinet"); },
                ThrowsSaying<ModelError>(HasSubstr("which a URDF cannot hold; expected printable UTF-8")))
        << frame;
  EXPECT_THAT([&] { toUrdf(door, std::string("x\0y", 3), "cabinet"); },
              ThrowsSaying<ModelError>(HasSubstr("the frame of the models has the byte 0x00 at position 2")));
  EXPECT_THAT([&] { toUrdf(door, "odom", "a\x02"); },
              ThrowsSaying<ModelError>(HasSubstr("the prefix of the names has the byte 0x02 at position 2")));
  EXPECT_THAT([&] { toUrdf(door, "", "cabinet"); }, ThrowsSaying<ModelError>(HasSubstr("has no name")));
}

TEST(Urdf, NamesAreThereOnce) {
  EXPECT_THAT(
      [] {
        parse({test::doorModel(), test::doorModel()});
      },
      ThrowsSaying<ModelError>(HasSubstr("there are two links 'cabinet_3_base'")));
  EXPECT_THAT([] { toUrdf({test::doorModel()}, "cabinet_3_front", "cabinet"); },
              ThrowsSaying<ModelError>(HasSubstr("there are two links 'cabinet_3_front'")));
}

}  // namespace
}  // namespace cabinet_articulation::core
