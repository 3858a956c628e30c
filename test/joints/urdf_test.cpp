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

TEST(Urdf, WhatHangsOnAFrontHangsOnItsLink) {
  LearnedModel rack = test::drawerModel();
  rack.parent = 3;
  rack.origin = Eigen::Isometry3d(Eigen::Translation3d(0.02, -0.1, -0.1));
  rack.axis = Eigen::Vector3d::UnitZ();
  const auto description = parse({rack, test::doorModel()});
  ASSERT_TRUE(description);
  EXPECT_EQ(description->getLink("cabinet_4_base")->getParent()->name, "cabinet_3_front");
  for (const double q : {0.0, 0.25}) {
    const Eigen::Isometry3d pose = linkPose(*description, "cabinet_4_front", q);  // both joints at q
    EXPECT_TRUE(pose.isApprox(test::doorModel().predict(q) * rack.predict(q), kPrecision)) << q;
  }
  EXPECT_THAT([&] { toUrdf({rack}, "odom", "cabinet"); },
              ThrowsSaying<ModelError>(HasSubstr("front 4 hangs on front 3, which is not known")));
}

TEST(Urdf, LimitsAreWhatWasSeen) {
  const auto description = parse({test::doorModel(), test::drawerModel()});
  const auto door = description->getJoint("front_3"), drawer = description->getJoint("front_4");
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

LearnedModel named(const std::string& name, LearnedModel model) {
  model.name = name;
  return model;
}

TEST(Urdf, NamesAreThoseOfJointsAndOfAFrameMore) {
  const LearnedModel door = named("fridge", test::doorModel());
  const auto description = parse({door, test::drawerModel()});
  ASSERT_TRUE(description);
  const auto joint = description->getJoint("fridge");
  ASSERT_TRUE(joint);
  EXPECT_EQ(joint->type, urdf::Joint::REVOLUTE);
  EXPECT_EQ(joint->child_link_name, "cabinet_3_leaf");
  EXPECT_FALSE(description->getJoint("front_3"));
  EXPECT_TRUE(description->getJoint("front_4")) << "without a name";
  ASSERT_TRUE(description->getLink("cabinet_fridge"));
  EXPECT_TRUE(linkPose(*description, "cabinet_fridge", 0.5).isApprox(door.predict(0.5), kPrecision));
  EXPECT_TRUE(linkPose(*description, "cabinet_3_front", 0.5).isApprox(door.predict(0.5), kPrecision));
  EXPECT_FALSE(description->getLink("cabinet_front_4"));
}

TEST(Urdf, NoNameOfAFrontIsThatOfAnotherJointOrLink) {
  for (const char* const name : {"cabinet_3_base", "cabinet_3_front_fixed", "cabinet_4_joint", "body"})
    EXPECT_TRUE(parse({named(name, test::doorModel()), test::drawerModel()})) << name;
  EXPECT_THAT(
      [] {
        parse({named("fridge", test::doorModel()), named("fridge", test::drawerModel())});
      },
      ThrowsSaying<ModelError>(HasSubstr("there are two links 'cabinet_fridge'")));
  EXPECT_THAT([] { parse({named("x\x01", test::doorModel())}); },
              ThrowsSaying<ModelError>(HasSubstr("the name of front 3 has the byte 0x01")));
}

TEST(Urdf, FrontsOfOnePieceOfFurnitureHangOnOneBody) {
  LearnedModel drawer = test::drawerModel(), far = test::drawerModel();
  drawer.origin = test::facingCamera(0.1, 0.4, 1.2);  // below the door, in its surface
  far.id = 9;
  far.origin = test::facingCamera(0.1, 0.4, 2.2);
  const auto description = parse({test::doorModel(), drawer, far});
  ASSERT_TRUE(description);
  const auto body = description->getLink("cabinet_3_body");
  ASSERT_TRUE(body);
  EXPECT_EQ(body->getParent()->name, "odom");
  EXPECT_EQ(body->child_links.size(), 2u);
  EXPECT_TRUE(linkPose(*description, "cabinet_3_body", 0).isApprox(test::facingCamera(0.1, 0.2, 1.2), kPrecision)) << "amid them";
  for (const char* const base : {"cabinet_3_base", "cabinet_4_base"})
    EXPECT_EQ(description->getLink(base)->getParent()->name, "cabinet_3_body");
  EXPECT_EQ(description->getLink("cabinet_9_base")->getParent()->name, "odom");
  EXPECT_FALSE(description->getLink("cabinet_9_body"));
  for (const LearnedModel& model : {test::doorModel(), drawer, far}) {
    const std::string front = "cabinet_" + std::to_string(model.id) + "_front";
    for (const double q : {0.0, 0.3})
      EXPECT_TRUE(linkPose(*description, front, q).isApprox(model.predict(q), kPrecision)) << front;
    const auto panel = description->getLink(front)->collision;
    ASSERT_TRUE(panel) << front;
    EXPECT_NEAR(std::dynamic_pointer_cast<urdf::Box>(panel->geometry)->dim.x, model.width, kPrecision);
  }
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
