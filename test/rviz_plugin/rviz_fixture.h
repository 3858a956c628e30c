// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreManualObject.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <rviz/display.h>
#include <rviz/render_panel.h>
#include <rviz/visualization_manager.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <QApplication>
#include <memory>

#include "support/moving_fronts.h"

namespace cabinet_articulation {
namespace test {

/// Noise of 1 mm: as the answers of the services.
constexpr double kNear = 0.008;

inline bool waitFor(const std::function<bool()>& done) {
  return spinUntil([&] {
    QApplication::processEvents();
    return done();
  });
}

inline ArticulationModelArray modelsOf(const std::vector<core::LearnedModel>& models, const std::string& frame) {
  std_msgs::Header header;
  header.frame_id = frame;
  return toMessage(models, header);
}

/// A process can have one.
struct Rviz {
  Rviz() : manager(&window) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(T_room_map);
    transform.header.stamp = ros::Time::now();
    transform.header.frame_id = "room";
    transform.child_frame_id = "map";
    broadcaster.sendTransform(transform);
    window.resize(320, 240);
    window.initialize(manager.getSceneManager(), &manager);
    manager.initialize();
    manager.setFixedFrame("room");
    manager.startUpdate();
  }

  const Eigen::Isometry3d T_room_map =
      Eigen::Translation3d(3, 1, 1) * Eigen::Isometry3d(Eigen::AngleAxisd(-M_PI / 2, Eigen::Vector3d::UnitX()));
  tf2_ros::StaticTransformBroadcaster broadcaster;
  rviz::RenderPanel window;
  rviz::VisualizationManager manager;
};

inline std::unique_ptr<Rviz> running;

class RvizPlugin : public MovingFronts {
 protected:
  RvizPlugin() : MovingFronts("cabinet") {}

  void TearDown() override { manager_.removeAllDisplays(); }

  rviz::Display* addDisplay(const QString& type) {
    rviz::Display* display = manager_.createDisplay("cabinet_articulation/" + type, type, true);
    EXPECT_EQ(display->getClassId(), "cabinet_articulation/" + type) << "not a display that could not be loaded";
    return display;
  }

  /// The list is called "Status: Ok" or so.
  static QString statusOf(rviz::Display* display, const QString& name) {
    for (int i = 0; i < display->numChildren(); ++i)
      if (display->childAt(i)->getName().startsWith("Status"))
        for (int k = 0; k < display->childAt(i)->numChildren(); ++k)
          if (display->childAt(i)->childAt(k)->getName() == name) return display->childAt(i)->childAt(k)->getValue().toString();
    return "";
  }

  /// In the fixed frame, what holds these rectangles of the map.
  Eigen::AlignedBox3d boxOf(const std::vector<core::Rectangle>& rectangles) const {
    Eigen::AlignedBox3d box;
    for (const core::Rectangle& rectangle : rectangles)
      for (const Eigen::Vector3d& corner : rectangle.corners()) box.extend(running->T_room_map * corner);
    return box;
  }

  /// Whether surfaces are drawn, below this node of the scene, that fill this box.
  static bool drawnIn(Ogre::SceneNode* node, const Eigen::AlignedBox3d& box) {
    bool found = false;
    for (unsigned short i = 0; i < node->numAttachedObjects(); ++i) {
      auto* object = dynamic_cast<Ogre::ManualObject*>(node->getAttachedObject(i));
      if (!object || object->getBoundingBox().isNull() || !object->isVisible()) continue;
      const Ogre::AxisAlignedBox drawn = object->getWorldBoundingBox(true);
      for (int k = 0; k < 3; ++k) {
        if (std::abs(drawn.getMinimum()[k] - box.min()(k)) > kNear || std::abs(drawn.getMaximum()[k] - box.max()(k)) > kNear)
          break;
        if (k == 2) found = true;
      }
    }
    for (unsigned short i = 0; !found && i < node->numChildren(); ++i)
      found = drawnIn(static_cast<Ogre::SceneNode*>(node->getChild(i)), box);
    return found;
  }

  static bool drawsAnything(Ogre::SceneNode* node) {
    for (unsigned short i = 0; i < node->numAttachedObjects(); ++i)
      if (!node->getAttachedObject(i)->getBoundingBox().isNull()) return true;
    for (unsigned short i = 0; i < node->numChildren(); ++i)
      if (drawsAnything(static_cast<Ogre::SceneNode*>(node->getChild(i)))) return true;
    return false;
  }

  /// As the last frame of play() shows them.
  std::vector<core::Rectangle> truth() const {
    return {{doorPose(1.4), 0.4, 0.6}, {drawerPose(0.3), 0.4, 0.2}, {wallPose(0), 0.4, 0.6}};
  }

  static void unloadArticulation() {
    nodelet::NodeletUnload call;
    call.request.name = "/cabinet/articulation";
    ASSERT_TRUE(ros::service::call("/cabinet/manager/unload_nodelet", call));
    ASSERT_TRUE(call.response.success);
  }

  static void loadArticulation() {
    nodelet::NodeletLoad call;
    call.request.name = "/cabinet/articulation";
    call.request.type = "cabinet_articulation/articulation";
    ASSERT_TRUE(ros::service::call("/cabinet/manager/load_nodelet", call));
    ASSERT_TRUE(call.response.success);
  }

  rviz::VisualizationManager& manager_ = running->manager;
};

}  // namespace test
}  // namespace cabinet_articulation
