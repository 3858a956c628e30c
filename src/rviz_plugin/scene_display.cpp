// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/scene_display.h"

#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>

namespace cabinet_articulation {

SceneDisplay::SceneDisplay() {
  color_by_ = new rviz::EnumProperty("Color", "Id", "What the colour tells.", this, SLOT(changed()), this);
  color_by_->addOption("Id", static_cast<int>(ColorBy::kId));
  color_by_->addOption("Type", static_cast<int>(ColorBy::kType));
  color_by_->addOption("Probability", static_cast<int>(ColorBy::kProbability));
  color_by_->addOption("Time", static_cast<int>(ColorBy::kTime));
  const LineStyle style;
  line_width_ = new rviz::FloatProperty("Line Width", style.width, "[m]; 0: one pixel.", this, SLOT(changed()), this);
  line_width_->setMin(0);
  text_height_ = new rviz::FloatProperty("Text Height", style.text_height, "[m]", this, SLOT(changed()), this);
  text_height_->setMin(0);
  timeout_ = new rviz::FloatProperty("Timeout", static_cast<float>(kSilence),
                                     "[s] of ROS time after which what nobody tells any more disappears; 0: never.", this,
                                     SLOT(changed()), this);
  timeout_->setMin(0);
}

void SceneDisplay::reset() {
  Display::reset();
  forget();
  if (isEnabled()) resubscribe();
}

void SceneDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  if (dirty_) {
    dirty_ = false;
    redraw();
    context_->queueRender();
  }
  follow();
}

void SceneDisplay::onEnable() {
  subscribe();
  changed();
}

void SceneDisplay::onDisable() {
  unsubscribe();
  forget();
  redraw();
}

void SceneDisplay::resubscribe() {
  unsubscribe();
  forget();
  if (isEnabled()) subscribe();
  changed();
}

rviz::RosTopicProperty* SceneDisplay::addTopic(const QString& name, const QString& topic, const std::string& type,
                                               const QString& description) {
  return new rviz::RosTopicProperty(name, topic, QString::fromStdString(type), description, this, SLOT(resubscribe()), this);
}

ColorBy SceneDisplay::colorBy() const { return static_cast<ColorBy>(color_by_->getOptionInt()); }

LineStyle SceneDisplay::lineStyle() const { return {line_width_->getFloat(), text_height_->getFloat()}; }

double SceneDisplay::timeout() const { return timeout_->getFloat(); }

void SceneDisplay::place(const std_msgs::Header& header, const QString& status, ShownDrawing* drawing) {
  rviz::FrameManager* frames = context_->getFrameManager();
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  const bool known = frames->getTransform(header, position, orientation) ||
                     frames->getTransform(header.frame_id, ros::Time(), position, orientation);
  drawing->setVisible(known);
  if (known) {
    drawing->place(position, orientation);
    deleteStatus(status);
    return;
  }
  std::string why;
  if (!frames->transformHasProblems(header.frame_id, ros::Time(), why)) why = "not known yet";
  setStatusStd(rviz::StatusProperty::Error, status.toStdString(), header.frame_id + ": " + why);
}

}  // namespace cabinet_articulation
