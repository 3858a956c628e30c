// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/joints_display.h"

#include <rviz/properties/bool_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/int_property.h>
#include <rviz/properties/ros_topic_property.h>

#include <pluginlib/class_list_macros.hpp>

#include "cabinet_articulation/joints/hanging.h"
#include "rviz_plugin/joint_table.h"

namespace cabinet_articulation {
namespace {

constexpr int kMostGhosts = 100;  ///< ours: more cannot be told apart
enum GhostsAt { kRange, kObservations };
enum UniqueBy { kTrack, kType };

}  // namespace

using rviz::StatusProperty;

JointsDisplay::JointsDisplay() {
  models_topic_ =
      addTopic("Models", "cabinet/models", ros::message_traits::datatype<ArticulationModelArray>(), "What was learned.");
  tracks_topic_ = addTopic("Tracks", "cabinet/tracks", ros::message_traits::datatype<TrackArray>(),
                           "The observations, listened to while ghosts are drawn at them.");
  const JointStyle style;
  alpha_ = new rviz::FloatProperty("Alpha", style.alpha, "Of the surfaces, 0 to 1.", this, SLOT(changed()), this);
  alpha_->setMin(0);
  alpha_->setMax(1);
  ghosts_ = new rviz::IntProperty("Ghosts", style.ghosts, "Outlines of each front at other openings; 0: none.", this,
                                  SLOT(changed()), this);
  ghosts_->setMin(0);
  ghosts_->setMax(kMostGhosts);
  ghosts_at_ = new rviz::EnumProperty("Ghosts At", "Range", "Evenly over the range that was seen, or at observations.", this,
                                      SLOT(resubscribe()), this);
  ghosts_at_->addOption("Range", kRange);
  ghosts_at_->addOption("Observations", kObservations);
  axis_ =
      new rviz::BoolProperty("Axis", style.axis, "Also the tube in which the axis lies with 95 %.", this, SLOT(changed()), this);
  label_ = new rviz::BoolProperty("Label", style.label, "Name, type, probability and opening.", this, SLOT(changed()), this);
  unique_by_ = new rviz::EnumProperty("Unique By", "Track", "Every front; or of each type the one that was seen last.", this,
                                      SLOT(changed()), this);
  unique_by_->addOption("Track", kTrack);
  unique_by_->addOption("Type", kType);
  resting_ = new rviz::BoolProperty("Resting Fronts", style.resting, "Also fronts that were not seen to be joints.", this,
                                    SLOT(changed()), this);
}

JointsDisplay::~JointsDisplay() { unsubscribe(); }

void JointsDisplay::setTopic(const QString& topic, const QString& /*datatype*/) { models_topic_->setString(topic); }

void JointsDisplay::onInitialize() { shown_ = std::make_unique<ShownDrawing>(scene_manager_, scene_node_); }

void JointsDisplay::subscribe() {
  models_input_.subscribe(update_nh_, models_topic_->getTopicStd(), [this](const auto& message) { take(message); });
  if (ghosts_at_->getOptionInt() != kObservations) return;
  tracks_input_.subscribe(update_nh_, tracks_topic_->getTopicStd(), [this](const auto& message) { take(message); });
}

void JointsDisplay::unsubscribe() {
  models_input_.shutdown();
  tracks_input_.shutdown();
}

void JointsDisplay::take(const ArticulationModelArray& message) {
  std::string left_out;
  models_ = usableModels(message, &left_out);
  lost_ = models_.size() - core::thoseOnKnown(models_).size();
  header_ = message.header;
  if (left_out.empty()) {
    deleteStatus(kRefusedModels);
  } else {
    setStatusStd(StatusProperty::Error, kRefusedModels, left_out);
  }
  changed();
}

void JointsDisplay::take(const TrackArray& message) {
  takeOrRefuse(kRefusedTracks, [&] {
    tracks_.add(fromMessage(message));
    tracks_frame_ = message.header.frame_id;
  });
}

void JointsDisplay::forget() {
  models_.clear();
  tracks_.clear();
  for (const char* status : {kRefusedModels, kRefusedTracks, kTransform}) deleteStatus(status);
  changed();
}

JointStyle JointsDisplay::jointStyle() const {
  JointStyle style;
  style.color_by = colorBy();
  style.alpha = alpha_->getFloat();
  style.ghosts = ghosts_->getInt();
  style.at_observations = ghosts_at_->getOptionInt() == kObservations;
  style.axis = axis_->getBool();
  style.label = label_->getBool();
  style.one_of_each_type = unique_by_->getOptionInt() == kType;
  style.resting = resting_->getBool();
  return style;
}

void JointsDisplay::redraw() {
  Drawing drawing;
  const bool same_frame = tracks_frame_ == header_.frame_id;
  drawJoints(models_, same_frame ? tracks_.tracks() : std::vector<core::Track>(), jointStyle(), &drawing);
  shown_->show(drawing, lineStyle());
}

void JointsDisplay::follow() {
  const bool gone = models_input_.isStale(timeout());
  if (gone && !models_.empty()) forget();
  if (gone) deleteStatus(kRefusedModels);
  if (!models_input_.isWanted()) return setStatus(StatusProperty::Warn, "Models", "no topic is chosen");
  if (models_input_.count() == 0 || gone) {
    setStatusStd(StatusProperty::Warn, "Models", models_input_.whatIsMissing());
    return;
  }
  const std::string summary = summaryOf(models_) + (lost_ > 0 ? "; " + std::to_string(lost_) + " hang on unknown fronts" : "");
  setStatusStd(lost_ > 0 ? StatusProperty::Warn : StatusProperty::Ok, "Models", summary);
  if (models_.empty()) return deleteStatus(kTransform);
  place(header_, kTransform, shown_.get());
}

}  // namespace cabinet_articulation

PLUGINLIB_EXPORT_CLASS(cabinet_articulation::JointsDisplay, rviz::Display)
