// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/TrackArray.h>

#include <memory>
#include <vector>

#include "cabinet_articulation/ros/conversions.h"
#include "rviz_plugin/joint_drawing.h"
#include "rviz_plugin/scene_display.h"

namespace rviz {
class BoolProperty;
class IntProperty;
}  // namespace rviz

namespace cabinet_articulation {

/// What was learned: each front at its opening now, where else it can be, and its axis with what is not known of it.
class JointsDisplay : public SceneDisplay {
  Q_OBJECT

 public:
  JointsDisplay();
  ~JointsDisplay() override;

  void setTopic(const QString& topic, const QString& datatype) override;

 private:
  static constexpr char kRefusedModels[] = "Refused models", kRefusedTracks[] = "Refused tracks", kTransform[] = "Transform";

  void onInitialize() override;
  void subscribe() override;
  void unsubscribe() override;
  void forget() override;
  void redraw() override;
  void follow() override;

  void take(const ArticulationModelArray& message);
  void take(const TrackArray& message);
  JointStyle jointStyle() const;

  rviz::RosTopicProperty *models_topic_, *tracks_topic_;
  rviz::EnumProperty *ghosts_at_, *unique_by_;
  rviz::IntProperty* ghosts_;
  rviz::FloatProperty* alpha_;
  rviz::BoolProperty *axis_, *label_, *resting_;

  LatestMessage<ArticulationModelArray> models_input_;
  LatestMessage<TrackArray> tracks_input_;

  std_msgs::Header header_;
  std::string tracks_frame_;
  std::vector<core::LearnedModel> models_;
  std::size_t lost_ = 0;  ///< of the models, those whose parent is not among them
  core::TrackAssembly tracks_;
  std::unique_ptr<ShownDrawing> shown_;
};

}  // namespace cabinet_articulation
