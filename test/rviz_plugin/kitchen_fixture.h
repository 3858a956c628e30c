// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/Predict.h>
#include <rviz/panel.h>
#include <std_srvs/Trigger.h>

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <fstream>
#include <pluginlib/class_loader.hpp>
#include <sstream>

#include "cabinet_articulation/joints/model_file.h"
#include "rviz_plugin/rviz_fixture.h"

namespace cabinet_articulation {
namespace test {

/// The panel, with the articulation nodelet in the namespace "cabinet".
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

  /// The fronts of earlier tests are forgotten.
  void playUntilShown(double start) {
    std_srvs::Trigger reset;
    ASSERT_TRUE(ros::service::call("/cabinet/reset", reset));
    play(start);
    ASSERT_TRUE(waitFor([&] { return table()->rowCount() == 2; }));
  }

  void saveAndExport() {
    const std::string file = testing::TempDir() + "kitchen_panel.yaml", description = testing::TempDir() + "kitchen_panel.urdf";
    for (const std::string& old : {file, description}) std::remove(old.c_str());
    find<QLineEdit>("file")->setText(QString::fromStdString(file));
    find<QPushButton>("save")->click();
    ASSERT_TRUE(answered("2 fronts saved"));
    find<QPushButton>("urdf")->click();
    ASSERT_TRUE(answered("is no robot description"));
    const core::ModelFile saved = core::readModelFile(file);
    ASSERT_EQ(saved.fronts.size(), 2u) << "it is left as it is";
    EXPECT_EQ(saved.fronts[0].model.name, "fridge");

    find<QLineEdit>("file")->setText(QString::fromStdString(description));
    for (const char* time : {"new", "again"}) {
      find<QLabel>("answer")->clear();
      find<QPushButton>("urdf")->click();
      ASSERT_TRUE(answered("URDF written")) << time;
    }
    std::stringstream written;
    written << std::ifstream(description).rdbuf();
    EXPECT_NE(written.str().find("\"fridge\""), std::string::npos);
  }

  void forgetAndReset(std::uint32_t first, std::uint32_t second) {
    find<QPushButton>("forget")->click();
    EXPECT_EQ(find<QPushButton>("forget")->text().toStdString(), "Really forget?");
    // A request that the first click made would be answered by then.
    spinUntil([] { return QApplication::processEvents(), false; }, 0.5);
    EXPECT_TRUE(predict(first, 0).success) << "the first click asks";
    find<QPushButton>("forget")->click();
    ASSERT_TRUE(answered("forgot"));
    EXPECT_FALSE(predict(first, 0).success);
    EXPECT_TRUE(predict(second, 0).success);
    find<QPushButton>("reset")->click();
    find<QPushButton>("reset")->click();
    ASSERT_TRUE(answered("everything is forgotten"));
    EXPECT_FALSE(predict(second, 0).success);
  }

  void listenToOther() {
    find<QComboBox>("namespace")->setCurrentText("other");
    other_ = ros::NodeHandle().advertise<ArticulationModelArray>("/other/models", 1);
  }

  /// Each of these models has a row.
  bool showsRows(const std::vector<core::LearnedModel>& models) {
    return waitFor([&] {
      other_.publish(modelsOf(models, "map"));
      return table()->rowCount() == static_cast<int>(models.size());
    });
  }

  void closePanel() { panel_.reset(); }

 private:
  ros::Publisher other_;
  pluginlib::ClassLoader<rviz::Panel> loader_{"rviz", "rviz::Panel"};
  boost::shared_ptr<rviz::Panel> panel_;
};

}  // namespace test
}  // namespace cabinet_articulation
