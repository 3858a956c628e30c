// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/preview.h"

#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>

#include "cabinet_articulation/ros/pose_conversions.h"

namespace cabinet_articulation {
namespace {

constexpr Color kFrontColor{1, 1, 1};  ///< none of those that say what was learned
constexpr Color kPathColor = core::palette::kReddishPurple;
constexpr float kAlpha = 0.25F;

}  // namespace

Preview::Preview(rviz::DisplayContext* context) : context_(context) {
  if (!context_) return;
  Ogre::SceneManager* scene = context_->getSceneManager();
  shown_ = std::make_unique<ShownDrawing>(scene, scene->getRootSceneNode());
}

void Preview::showFront(const std_msgs::Header& header, const core::LearnedModel& model,
                        const geometry_msgs::PoseWithCovariance& pose) {
  const core::Rectangle front{fromMessage(pose.pose), model.width, model.height};
  header_ = header;
  front_ = {};
  addSurface(front, {kFrontColor, kAlpha}, &front_);
  addOutline(front, {kFrontColor}, &front_);
  redraw();
}

void Preview::showPath(const std_msgs::Header& header, const std::vector<geometry_msgs::PoseWithCovariance>& path) {
  std::vector<Eigen::Vector3d> points;
  for (const geometry_msgs::PoseWithCovariance& pose : path) points.push_back(fromMessage(pose.pose.position));
  header_ = header;
  path_ = {};
  addPath(points, {kPathColor}, &path_);
  redraw();
}

void Preview::hidePath() {
  path_ = {};
  redraw();
}

void Preview::clear() {
  front_ = {};
  path_ = {};
  redraw();
}

void Preview::redraw() {
  if (!shown_) return;
  Drawing both = front_;
  both.lines.insert(both.lines.end(), path_.lines.begin(), path_.lines.end());
  shown_->show(both, LineStyle());
  follow();
}

void Preview::follow() {
  if (!shown_ || header_.frame_id.empty()) return;
  Ogre::Vector3 position;
  Ogre::Quaternion orientation;
  const bool known = context_->getFrameManager()->getTransform(header_.frame_id, ros::Time(), position, orientation);
  shown_->setVisible(known);
  if (known) shown_->place(position, orientation);
  context_->queueRender();
}

}  // namespace cabinet_articulation
