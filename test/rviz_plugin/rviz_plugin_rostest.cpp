// SPDX-License-Identifier: BSD-3-Clause
// Displays and panel in RViz, before an articulation nodelet that learns a door and a drawer.
#include <cabinet_articulation/ExportUrdf.h>
#include <cabinet_articulation/Predict.h>
#include <rviz/panel.h>

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTableWidget>
#include <fstream>
#include <pluginlib/class_loader.hpp>
#include <sstream>

#include "cabinet_articulation/joints/model_file.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "rviz_plugin/rviz_fixture.h"
#include "rviz_plugin/virtual_display.h"

namespace cabinet_articulation {
namespace {

using test::RvizPlugin;
using test::waitFor;

class Kitchen : public RvizPlugin {
 protected:
  Kitchen() : panel_(loader_.createInstance("cabinet_articulation/Kitchen")) { panel_->initialize(&manager_); }

  template <class Widget>
  Widget* find(const char* name) {
    auto* widget = panel_->findChild<Widget*>(name);
    EXPECT_TRUE(widget) << name;
    return widget;
  }

  QTableWidget* table() { return find<QTableWidget>("joints"); }
  std::string answer() { return find<QLabel>("answer")->text().toStdString(); }
  bool answered(const std::string& words) {
    return waitFor([&] { return answer().find(words) != std::string::npos; });
  }

  static Predict::Response predict(std::uint32_t id, double q) {
    Predict call;
    call.request.id = id;
    call.request.q = {q};
    EXPECT_TRUE(ros::service::call("/cabinet/predict", call));
    return call.response;
  }

  void playUntilShown(double start) {
    play(start);
    ASSERT_TRUE(waitFor([&] { return table()->rowCount() == 2; }));
  }

  pluginlib::ClassLoader<rviz::Panel> loader_{"rviz", "rviz::Panel"};
  boost::shared_ptr<rviz::Panel> panel_;
};

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

TEST_F(RvizPlugin, ModelsOfAFrameThatNobodyKnowsAreHiddenAndItSaysSo) {
  rviz::Display* joints = addDisplay("Joints");
  frame_id_ = "nowhere";
  play(200);
  EXPECT_TRUE(waitFor([&] { return statusOf(joints, "Transform of nowhere").contains("nowhere"); }));
  EXPECT_FALSE(drawnIn(joints->getSceneNode(), boxOf(truth())));
}

TEST_F(Kitchen, NamesSlidesSavesAndForgets) {
  playUntilShown(300);
  const std::uint32_t door = tracks_[0].id, drawer = tracks_[1].id;

  table()->item(0, 0)->setText("fridge");
  ASSERT_TRUE(answered("fridge"));
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

  const std::string file = testing::TempDir() + "kitchen_panel.yaml";
  std::remove(file.c_str());
  find<QLineEdit>("file")->setText(QString::fromStdString(file));
  find<QPushButton>("save")->click();
  ASSERT_TRUE(answered("2 fronts saved"));
  const core::ModelFile saved = core::readModelFile(file);
  ASSERT_EQ(saved.fronts.size(), 2u);
  EXPECT_EQ(saved.fronts[0].model.name, "fridge");

  const std::string description = testing::TempDir() + "kitchen_panel.urdf";
  find<QLineEdit>("file")->setText(QString::fromStdString(description));
  find<QPushButton>("urdf")->click();
  ASSERT_TRUE(answered("URDF written"));
  std::stringstream written;
  written << std::ifstream(description).rdbuf();
  EXPECT_NE(written.str().find("\"fridge\""), std::string::npos);

  find<QPushButton>("forget")->click();
  EXPECT_TRUE(predict(door, 0).success) << "the first click asks";
  find<QPushButton>("forget")->click();
  ASSERT_TRUE(answered("forgot"));
  EXPECT_FALSE(predict(door, 0).success);
  EXPECT_TRUE(predict(drawer, 0).success);
  find<QPushButton>("reset")->click();
  find<QPushButton>("reset")->click();
  ASSERT_TRUE(answered("everything is forgotten"));
  EXPECT_FALSE(predict(drawer, 0).success);
}

TEST_F(Kitchen, APipelineThatIsGoneLeavesNothingAndMayComeBack) {
  rviz::Display* joints = addDisplay("Joints");
  playUntilShown(400);
  ASSERT_TRUE(waitFor([&] { return drawsAnything(joints->getSceneNode()); }));
  unloadArticulation();
  EXPECT_TRUE(waitFor([&] { return table()->rowCount() == 0 && !drawsAnything(joints->getSceneNode()); }));
  EXPECT_TRUE(waitFor([&] { return find<QLabel>("summary")->text().contains("nobody publishes /cabinet/models"); }));
  find<QPushButton>("save")->click();
  EXPECT_TRUE(answered("/cabinet/save_models is not there"));
  // It comes back, and knows nothing yet.
  loadArticulation();
  SetUp();
  playUntilShown(500);
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
