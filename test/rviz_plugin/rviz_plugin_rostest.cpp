// SPDX-License-Identifier: BSD-3-Clause
// Displays and panel in RViz, before an articulation nodelet that learns a door and a drawer.
#include <cabinet_articulation/ExportUrdf.h>

#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "rviz_plugin/kitchen_fixture.h"
#include "rviz_plugin/sleeping_service.h"
#include "rviz_plugin/virtual_display.h"
#include "support/models.h"

namespace cabinet_articulation {
namespace {

using test::Kitchen;
using test::modelsOf;
using test::RvizPlugin;
using test::waitFor;

TEST_F(RvizPlugin, FrontsAreDrawnWhereTheyAre) {
  rviz::Display* fronts = addDisplay("Fronts");
  ros::Publisher output = nh_.advertise<RectangleArray>("rectangles", 1);
  std::vector<core::DetectedRectangle> detected;
  for (const core::Rectangle& rectangle : truth()) {
    core::DetectedRectangle seen;
    seen.rectangle = rectangle;
    seen.edge_support = {{1, 1, 0.5F, 0}};
    detected.push_back(seen);
  }
  std_msgs::Header header;
  header.frame_id = "map";
  EXPECT_TRUE(waitFor([&] {
    output.publish(toMessage(detected, header));
    return drawnIn(fronts->getSceneNode(), boxOf(truth()));
  }));
  // A pipeline that was killed is silent, and the master still has its name.
  fronts->subProp("Timeout")->setValue(0.3);
  EXPECT_TRUE(waitFor([&] { return !drawsAnything(fronts->getSceneNode()); }));
  fronts->subProp("Timeout")->setValue(0);
  EXPECT_TRUE(waitFor([&] {
    output.publish(toMessage(detected, header));
    return drawnIn(fronts->getSceneNode(), boxOf(truth()));
  })) << "it comes back";
  // One that ended says so.
  output.shutdown();
  EXPECT_TRUE(waitFor([&] { return !drawsAnything(fronts->getSceneNode()); }));
  EXPECT_TRUE(statusOf(fronts, "Rectangles").contains("nobody publishes /cabinet/rectangles"));
}

TEST_F(RvizPlugin, JointsAreDrawnWhereTheFrontsAre) {
  rviz::Display* joints = addDisplay("Joints");
  for (const char* property : {"Axis", "Label"}) joints->subProp(property)->setValue(false);
  play(100);
  EXPECT_TRUE(waitFor([&] { return drawnIn(joints->getSceneNode(), boxOf(truth())); }));
  // Simulated time that jumps back and RViz' button do this; the next message is drawn again.
  joints->reset();
  EXPECT_TRUE(waitFor([&] { return !drawsAnything(joints->getSceneNode()); }));
  send(100 + test::kFrames / 15.0);
  EXPECT_TRUE(waitFor([&] { return drawnIn(joints->getSceneNode(), boxOf(truth())); }));
}

TEST_F(RvizPlugin, StatusesGoWithTheirCause) {
  rviz::Display* joints = addDisplay("Joints");
  joints->subProp("Models")->setValue("/other/models");
  ros::Publisher output = ros::NodeHandle().advertise<ArticulationModelArray>("/other/models", 1);
  core::LearnedModel door = test::doorModel();
  const Eigen::AlignedBox3d box = boxOf({core::frontAt(door, door.q)});
  const auto shown = [&](const std::string& frame, const std::function<bool()>& done) {
    return waitFor([&] {
      output.publish(modelsOf({door}, frame));
      return done();
    });
  };
  EXPECT_TRUE(shown("nowhere", [&] { return statusOf(joints, "Transform").contains("nowhere"); }));
  EXPECT_FALSE(drawnIn(joints->getSceneNode(), box));
  for (const char* property : {"Axis", "Label"}) joints->subProp(property)->setValue(false);
  joints->subProp("Ghosts")->setValue(0);
  EXPECT_TRUE(shown("map", [&] { return drawnIn(joints->getSceneNode(), box) && statusOf(joints, "Transform").isEmpty(); }));
  door.width = -1;
  EXPECT_TRUE(shown("map", [&] { return !statusOf(joints, "Refused models").isEmpty(); }));
  output.shutdown();
  EXPECT_TRUE(waitFor([&] { return statusOf(joints, "Refused models").isEmpty(); }));
}

TEST_F(RvizPlugin, WhatHangsOnADoorIsDrawnWhereTheDoorIs) {
  rviz::Display* joints = addDisplay("Joints");
  for (const char* property : {"Axis", "Label"}) joints->subProp(property)->setValue(false);
  joints->subProp("Ghosts")->setValue(0);
  joints->subProp("Models")->setValue("/other/models");
  ros::Publisher output = ros::NodeHandle().advertise<ArticulationModelArray>("/other/models", 1);
  const core::LearnedModel door = test::doorModel(), leaf = test::leafModel();
  const core::Rectangle door_now = core::frontAt(door, door.q), leaf_now{door_now.pose * leaf.predict(leaf.q), 0.4, 0.6};
  EXPECT_TRUE(waitFor([&] {
    output.publish(modelsOf({door, leaf}, "map"));
    return drawnIn(joints->getSceneNode(), boxOf({door_now, leaf_now}));
  }));
  EXPECT_TRUE(waitFor([&] {
    output.publish(modelsOf({leaf}, "map"));
    return statusOf(joints, "Models").contains("1 hang on unknown fronts") && !drawsAnything(joints->getSceneNode());
  }));
}

TEST_F(Kitchen, NamesSlidesSavesAndForgets) {
  ASSERT_NO_FATAL_FAILURE(playUntilShown(300));
  const std::uint32_t door = tracks_[0].id, drawer = tracks_[1].id;
  table()->item(0, 0)->setText("fridge");
  ASSERT_TRUE(answered("fridge"));
  EXPECT_EQ(table()->item(0, 0)->text().toStdString(), "fridge") << "before the next models tell";
  ExportUrdf urdf;
  ASSERT_TRUE(ros::service::call("/cabinet/export_urdf", urdf));
  EXPECT_NE(urdf.response.urdf.find("\"fridge\""), std::string::npos);
  table()->item(1, 0)->setText("fridge");
  ASSERT_TRUE(answered("would do")) << "a name that is taken is refused with a proposal";
  EXPECT_EQ(table()->item(1, 0)->text().toStdString(), "front_" + std::to_string(drawer));

  table()->selectRow(0);
  find<QSlider>("slider")->setValue(500);
  const Predict::Response half = predict(door, 0.7);
  ASSERT_TRUE(half.success);
  const core::Rectangle tried{fromMessage(half.poses.front().pose), 0.4, 0.6};
  EXPECT_TRUE(waitFor([&] { return drawnIn(manager_.getSceneManager()->getRootSceneNode(), boxOf({tried})); }));
  EXPECT_EQ(find<QLabel>("predicted")->text().toStdString(), "40 deg");

  ASSERT_NO_FATAL_FAILURE(saveAndExport());
  forgetAndReset(door, drawer);
}

TEST_F(Kitchen, RowsThatComeAndGoLeaveTheOthersAlone) {
  listenToOther();
  core::LearnedModel named = test::restingModel();
  named.name = "oven";
  const core::LearnedModel door = test::doorModel();
  ASSERT_TRUE(showsRows({door}));
  table()->selectRow(0);
  find<QSlider>("slider")->setValue(900);
  table()->editItem(table()->item(0, 0));
  const QPointer<QLineEdit> editor = table()->findChild<QLineEdit*>();
  ASSERT_TRUE(editor);
  editor->setText("fri");
  for (const auto& models : {std::vector<core::LearnedModel>{named, door}, {named, door, test::drawerModel()}, {door}}) {
    ASSERT_TRUE(showsRows(models));
    ASSERT_TRUE(editor) << "the name is still being edited";
    EXPECT_EQ(editor->text().toStdString(), "fri");
    EXPECT_EQ(find<QSlider>("slider")->value(), 900);
  }
  ASSERT_TRUE(showsRows({named, door}));
  EXPECT_TRUE(table()->selectionModel()->isRowSelected(1, QModelIndex()));
  ASSERT_TRUE(showsRows({named}));
  EXPECT_FALSE(table()->selectionModel()->hasSelection()) << "the next click on a button must not mean a neighbour";
  EXPECT_FALSE(find<QSlider>("slider")->isEnabled());
}

TEST_F(Kitchen, AServiceThatSleepsHoldsUpNobody) {
  listenToOther();
  test::SleepingService reset("/other/reset");
  for (int click = 0; click < 2; ++click) find<QPushButton>("reset")->click();
  ASSERT_TRUE(waitFor([&] { return reset.calls() == 1; }));
  EXPECT_TRUE(answered("/other/reset gave no answer within 10 s"));
  for (int click = 0; click < 2; ++click) find<QPushButton>("reset")->click();
  reset.wakeOnce();
  ASSERT_TRUE(waitFor([&] { return reset.calls() == 2; })) << "the next request is made";
  const ros::WallTime start = ros::WallTime::now();
  closePanel();
  EXPECT_LT((ros::WallTime::now() - start).toSec(), 3) << "closed while the service sleeps";
}

TEST_F(Kitchen, APipelineThatIsGoneLeavesNothingAndMayComeBack) {
  rviz::Display* joints = addDisplay("Joints");
  ASSERT_NO_FATAL_FAILURE(playUntilShown(400));
  ASSERT_TRUE(waitFor([&] { return drawsAnything(joints->getSceneNode()); }));
  unloadArticulation();
  EXPECT_TRUE(waitFor([&] { return table()->rowCount() == 0 && !drawsAnything(joints->getSceneNode()); }));
  EXPECT_TRUE(waitFor([&] { return find<QLabel>("summary")->text().contains("nobody publishes /cabinet/models"); }));
  find<QPushButton>("save")->click();
  EXPECT_TRUE(answered("/cabinet/save_models is not there"));
  // It comes back, and knows nothing yet.
  loadArticulation();
  SetUp();
  ASSERT_NO_FATAL_FAILURE(playUntilShown(500));
  EXPECT_EQ(table()->verticalHeaderItem(0)->text().toStdString(), std::to_string(tracks_[0].id));
}

}  // namespace
}  // namespace cabinet_articulation

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "rviz_plugin_test");
  const ros::NodeHandle nh;
  const cabinet_articulation::test::VirtualDisplay display;
  const QApplication application(argc, argv);
  cabinet_articulation::test::running = std::make_unique<cabinet_articulation::test::Rviz>();
  const int failed = RUN_ALL_TESTS();
  cabinet_articulation::test::running.reset();
  return failed;
}
