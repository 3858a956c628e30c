// SPDX-License-Identifier: BSD-3-Clause
// Two pipelines in two namespaces, whose fronts have equal ids: displays and panel show the one that is chosen.
#include <cabinet_articulation/ExportUrdf.h>

#include <QComboBox>
#include <QSlider>
#include <QTableWidget>

#include "cabinet_articulation/ros/pose_conversions.h"
#include "rviz_plugin/kitchen_fixture.h"

namespace cabinet_articulation {
namespace {

using test::waitFor;

/// The pipeline in the namespace `annex` sees one door, 2 m beside that of `cabinet`.
class Annex : public test::MovingFronts {
 public:
  explicit Annex(std::uint32_t id) : MovingFronts("annex") {
    SetUp();
    std_srvs::Trigger reset;
    EXPECT_TRUE(ros::service::call("/annex/reset", reset)) << "the doors of earlier tests are forgotten";
    tracks_.resize(1);
    tracks_[0].id = id;
  }

  void open(double start) {
    for (int i = 0; i < test::kFrames; ++i) {
      const double stamp = start + i / 15.0;
      observe(&tracks_[0], doorPose(1.4 * std::max(0, i - test::kAtRest) / (test::kFrames - 1 - test::kAtRest)), stamp);
      ASSERT_TRUE(publish(stamp));
    }
  }

  core::Rectangle door(double q) const { return {doorPose(q), 0.4, 0.6}; }
  using MovingFronts::send;

 private:
  void TestBody() override {}

  static Eigen::Isometry3d doorPose(double q) { return Eigen::Translation3d(2, 0, 0) * test::doorPose(q); }
};

class TwoKitchens : public test::Kitchen {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(Kitchen::SetUp());
    ASSERT_NO_FATAL_FAILURE(playUntilShown(600));
    annex_ = std::make_unique<Annex>(tracks_[0].id);
    ASSERT_NO_FATAL_FAILURE(annex_->open(600));
  }

  /// Both pipelines speak, and this is drawn below the node.
  bool showsAlone(Ogre::SceneNode* node, const std::vector<core::Rectangle>& shown, const std::vector<core::Rectangle>& other) {
    return waitFor([&] {
      speak();
      return drawnIn(node, boxOf(shown)) && !drawnIn(node, boxOf(other));
    });
  }

  void followsTopicsOf(rviz::Display* display) {
    const std::vector<core::Rectangle> annex = {annex_->door(1.4)};
    for (const char* ns : {"cabinet", "annex", "cabinet"}) {
      for (const char* topic : {"Models", "Tracks"})
        display->subProp(topic)->setValue(QString("/%1/%2").arg(ns, QString(topic).toLower()));
      const bool first = ns == std::string("cabinet");
      EXPECT_TRUE(showsAlone(display->getSceneNode(), first ? truth() : annex, first ? annex : truth())) << ns;
    }
  }

  bool showsRows(int rows) {
    return waitFor([&] {
      speak();
      return table()->rowCount() == rows;
    });
  }

  static std::string descriptionIn(const std::string& ns) {
    ExportUrdf call;
    EXPECT_TRUE(ros::service::call("/" + ns + "/export_urdf", call));
    return call.response.urdf;
  }

  std::unique_ptr<Annex> annex_;

 private:
  void speak() {
    stamp_ += 0.1;
    send(stamp_);
    annex_->send(stamp_);
  }

  double stamp_ = 610;
};

TEST_F(TwoKitchens, JointsShowTheOneWhoseTopicsAreChosen) {
  rviz::Display* joints = addDisplay("Joints");
  for (const char* property : {"Axis", "Label"}) joints->subProp(property)->setValue(false);
  joints->subProp("Ghosts")->setValue(0);
  followsTopicsOf(joints);
}

TEST_F(TwoKitchens, FrontsShowTheOneWhoseTopicsAreChosen) {
  rviz::Display* fronts = addDisplay("Fronts");
  fronts->subProp("Latest Only")->setValue(true);
  // Wide lines are billboards, whose box depends on where the camera is.
  fronts->subProp("Line Width")->setValue(0);
  followsTopicsOf(fronts);
}

TEST_F(TwoKitchens, ThePanelAsksTheOneThatIsChosen) {
  table()->selectRow(0);
  find<QComboBox>("namespace")->setCurrentText("annex");
  EXPECT_EQ(table()->rowCount(), 0) << "nothing of the other one stays";
  ASSERT_TRUE(showsRows(1));
  table()->item(0, 0)->setText("larder");
  ASSERT_TRUE(answered("larder"));
  EXPECT_NE(descriptionIn("annex").find("\"larder\""), std::string::npos);
  EXPECT_EQ(descriptionIn("cabinet").find("\"larder\""), std::string::npos) << "its front with the same id";

  table()->selectRow(0);
  find<QSlider>("slider")->setValue(500);
  Ogre::SceneNode* scene = manager_.getSceneManager()->getRootSceneNode();
  EXPECT_TRUE(waitFor([&] { return drawnIn(scene, boxOf({annex_->door(0.7)})); }));
  for (int click = 0; click < 2; ++click) find<QPushButton>("forget")->click();
  ASSERT_TRUE(answered("forgot"));
  EXPECT_TRUE(predict(tracks_[0].id, 0).success) << "forgotten in the annex alone";

  find<QComboBox>("namespace")->setCurrentText("cabinet");
  ASSERT_TRUE(showsRows(2));
  EXPECT_FALSE(drawnIn(scene, boxOf({annex_->door(0.7)})));
}

}  // namespace
}  // namespace cabinet_articulation
