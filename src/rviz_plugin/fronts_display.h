// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cabinet_articulation/ArticulationModelArray.h>
#include <cabinet_articulation/RectangleArray.h>
#include <cabinet_articulation/TrackArray.h>

#include <memory>
#include <vector>

#include "cabinet_articulation/ros/conversions.h"
#include "rviz_plugin/front_drawing.h"
#include "rviz_plugin/scene_display.h"

namespace rviz {
class BoolProperty;
}  // namespace rviz

namespace cabinet_articulation {

/// The rectangles of the newest frame, with what was observed of each edge, and the tracks they were joined into.
class FrontsDisplay : public SceneDisplay {
  Q_OBJECT

 public:
  FrontsDisplay();
  ~FrontsDisplay() override;

  void setTopic(const QString& topic, const QString& datatype) override;

 private:
  static constexpr char kRefusedRectangles[] = "Refused rectangles", kTransformOfRectangles[] = "Transform of rectangles";
  static constexpr char kRefusedTracks[] = "Refused tracks", kTransformOfTracks[] = "Transform of tracks";

  void onInitialize() override;
  void subscribe() override;
  void unsubscribe() override;
  void forget() override;
  void redraw() override;
  void follow() override;

  void forgetRectangles();
  void forgetTracks();
  const core::LearnedModel* modelOf(const core::Track& track) const;
  TrackStyle trackStyle() const;

  rviz::RosTopicProperty *rectangles_topic_, *tracks_topic_, *models_topic_;
  rviz::FloatProperty *density_, *alpha_;
  rviz::EnumProperty* style_;
  rviz::BoolProperty *latest_only_, *projected_;

  LatestMessage<RectangleArray> rectangles_input_;
  LatestMessage<TrackArray> tracks_input_;
  LatestMessage<ArticulationModelArray> models_input_;

  std_msgs::Header rectangles_header_, tracks_header_;
  std::string models_frame_;
  std::vector<core::DetectedRectangle> rectangles_;
  core::TrackAssembly tracks_;
  std::vector<core::LearnedModel> models_;
  std::unique_ptr<ShownDrawing> shown_rectangles_, shown_tracks_;
};

}  // namespace cabinet_articulation
