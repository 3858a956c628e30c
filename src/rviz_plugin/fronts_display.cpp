// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/fronts_display.h"

#include <rviz/properties/bool_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>

#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/joints/hanging.h"

namespace cabinet_articulation {

using rviz::StatusProperty;

FrontsDisplay::FrontsDisplay() {
  rectangles_topic_ = addTopic("Rectangles", "cabinet/rectangles", ros::message_traits::datatype<RectangleArray>(),
                               "What the newest frame shows; empty: none.");
  tracks_topic_ =
      addTopic("Tracks", "cabinet/tracks", ros::message_traits::datatype<TrackArray>(), "Each front's history; empty: none.");
  models_topic_ = addTopic("Models", "cabinet/models", ros::message_traits::datatype<ArticulationModelArray>(),
                           "Gives tracks the colours of their types, and where they are projected to; empty: none.");
  style_ = new rviz::EnumProperty("Style", "Rectangles", "Of the observations of a track, beside the way of its centre.", this,
                                  SLOT(changed()), this);
  style_->addOption("Rectangles", static_cast<int>(ObservationStyle::kRectangle));
  style_->addOption("Crosses", static_cast<int>(ObservationStyle::kCross));
  style_->addOption("Axes", static_cast<int>(ObservationStyle::kAxes));
  style_->addOption("Line", static_cast<int>(ObservationStyle::kLine));
  const TrackStyle style;
  density_ = new rviz::FloatProperty("Sample Density", static_cast<float>(style.density),
                                     "[1/m] Observations drawn for each metre of a track; 0: all.", this, SLOT(changed()), this);
  density_->setMin(0);
  latest_only_ = new rviz::BoolProperty("Latest Only", style.latest_only, "The newest observation of each track alone.", this,
                                        SLOT(changed()), this);
  projected_ = new rviz::BoolProperty("Projected", style.projected, "Observations where the learned model says they are.", this,
                                      SLOT(changed()), this);
  alpha_ = new rviz::FloatProperty("Alpha", style.alpha, "Of earlier observations, 0 to 1.", this, SLOT(changed()), this);
  alpha_->setMin(0);
  alpha_->setMax(1);
}

FrontsDisplay::~FrontsDisplay() { unsubscribe(); }

void FrontsDisplay::setTopic(const QString& topic, const QString& datatype) {
  const bool tracks = datatype == tracks_topic_->getMessageType();
  (tracks ? tracks_topic_ : rectangles_topic_)->setString(topic);
}

void FrontsDisplay::onInitialize() {
  shown_rectangles_ = std::make_unique<ShownDrawing>(scene_manager_, scene_node_);
  shown_tracks_ = std::make_unique<ShownDrawing>(scene_manager_, scene_node_);
}

void FrontsDisplay::subscribe() {
  rectangles_input_.subscribe(update_nh_, rectangles_topic_->getTopicStd(), [this](const RectangleArray& message) {
    takeOrRefuse(kRefusedRectangles, [&] {
      rectangles_ = fromMessage(message);
      rectangles_header_ = message.header;
    });
  });
  tracks_input_.subscribe(update_nh_, tracks_topic_->getTopicStd(), [this](const TrackArray& message) {
    takeOrRefuse(kRefusedTracks, [&] {
      tracks_.add(fromMessage(message));
      tracks_header_ = message.header;
    });
  });
  models_input_.subscribe(update_nh_, models_topic_->getTopicStd(), [this](const ArticulationModelArray& message) {
    std::string left_out;
    models_ = usableModels(message, &left_out);
    models_frame_ = message.header.frame_id;
    changed();
  });
}

void FrontsDisplay::unsubscribe() {
  rectangles_input_.shutdown();
  tracks_input_.shutdown();
  models_input_.shutdown();
}

void FrontsDisplay::forget() {
  forgetRectangles();
  forgetTracks();
}

void FrontsDisplay::forgetRectangles() {
  rectangles_.clear();
  for (const char* status : {kRefusedRectangles, kTransformOfRectangles}) deleteStatus(status);
  changed();
}

void FrontsDisplay::forgetTracks() {
  tracks_.clear();
  models_.clear();
  for (const char* status : {kRefusedTracks, kTransformOfTracks}) deleteStatus(status);
  changed();
}

const core::LearnedModel* FrontsDisplay::modelOf(const core::Track& track) const {
  return models_frame_ == tracks_header_.frame_id ? core::findModel(track.id, models_) : nullptr;
}

TrackStyle FrontsDisplay::trackStyle() const {
  TrackStyle style;
  style.observations = static_cast<ObservationStyle>(style_->getOptionInt());
  style.color_by = colorBy();
  style.density = density_->getFloat();
  style.latest_only = latest_only_->getBool();
  style.projected = projected_->getBool();
  style.alpha = alpha_->getFloat();
  return style;
}

void FrontsDisplay::redraw() {
  Drawing rectangles, tracks;
  drawRectangles(rectangles_, colorBy(), &rectangles);
  shown_rectangles_->show(rectangles, lineStyle());
  const TrackStyle style = trackStyle();
  for (const core::Track& track : tracks_.tracks()) drawTrack(track, modelOf(track), style, &tracks);
  shown_tracks_->show(tracks, lineStyle());
}

namespace {

/// What a list of fronts holds, or why there is none.
template <class Message>
void tell(const LatestMessage<Message>& input, bool gone, std::size_t fronts, const QString& name, rviz::Display* display) {
  if (!input.isWanted()) return display->deleteStatus(name);
  if (input.count() == 0 || gone) {
    display->setStatusStd(StatusProperty::Warn, name.toStdString(), input.whatIsMissing());
    return;
  }
  const QString text = QString::number(fronts) + " in the newest of " + QString::number(input.count()) + " messages";
  display->setStatus(StatusProperty::Ok, name, text);
}

}  // namespace

void FrontsDisplay::follow() {
  const bool no_rectangles = rectangles_input_.isStale(timeout()), no_tracks = tracks_input_.isStale(timeout());
  if (no_rectangles && !rectangles_.empty()) forgetRectangles();
  if (no_tracks && !tracks_.tracks().empty()) forgetTracks();
  if (no_rectangles) deleteStatus(kRefusedRectangles);
  if (no_tracks) deleteStatus(kRefusedTracks);
  if (rectangles_.empty()) deleteStatus(kTransformOfRectangles);
  if (tracks_.tracks().empty()) deleteStatus(kTransformOfTracks);
  tell(rectangles_input_, no_rectangles, rectangles_.size(), "Rectangles", this);
  tell(tracks_input_, no_tracks, tracks_.tracks().size(), "Tracks", this);
  if (!rectangles_.empty()) place(rectangles_header_, kTransformOfRectangles, shown_rectangles_.get());
  if (!tracks_.tracks().empty()) place(tracks_header_, kTransformOfTracks, shown_tracks_.get());
}

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::FrontsDisplay, rviz::Display)
