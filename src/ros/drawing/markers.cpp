// SPDX-License-Identifier: BSD-3-Clause
#include "ros/drawing/markers.h"

#include "cabinet_articulation/joints/joint.h"
#include "cabinet_articulation/ros/pose_conversions.h"
#include "ros/answers/joints.h"
#include "ros/drawing/model_drawing.h"

namespace cabinet_articulation {
namespace {

using visualization_msgs::Marker;

constexpr double kLineWidth = 0.005;   ///< [m]
constexpr double kTextHeight = 0.04;   ///< [m]
constexpr double kAxisRadius = 0.012;  ///< [m]

Marker marker(const std_msgs::Header& header, const std::string& ns, int id, int type, const Color& color) {
  Marker marker;
  marker.header = header;
  marker.ns = ns;
  marker.id = id;
  marker.type = type;
  marker.action = Marker::ADD;
  marker.pose.orientation.w = 1;
  marker.scale.x = kLineWidth;
  marker.color.r = color[0];
  marker.color.g = color[1];
  marker.color.b = color[2];
  marker.color.a = 1;
  return marker;
}

void addOutline(const core::Rectangle& rectangle, Marker* lines) {
  const auto corners = rectangle.corners();
  for (size_t i = 0; i < corners.size(); ++i) {
    lines->points.push_back(toPoint(corners[i]));
    lines->points.push_back(toPoint(corners[(i + 1) % corners.size()]));
  }
}

void addJoint(const core::LearnedModel& model, const std_msgs::Header& header, visualization_msgs::MarkerArray* markers) {
  const int id = static_cast<int>(model.id);
  const auto axis = axisOf(model);
  Marker arrow = marker(header, "axes", id, Marker::ARROW, kAxisColor);
  arrow.points = {toPoint(axis.first), toPoint(axis.second)};
  arrow.scale.x = kAxisRadius;
  arrow.scale.y = 2 * kAxisRadius;
  markers->markers.push_back(arrow);

  Marker way = marker(header, "ways", id, Marker::LINE_STRIP, colorOf(model));
  for (const Eigen::Vector3d& p : wayOf(model, model.q_min, model.q_max)) way.points.push_back(toPoint(p));
  markers->markers.push_back(way);

  Marker sweep = marker(header, "sweep", id, Marker::LINE_LIST, colorOf(model));
  sweep.scale.x = kLineWidth / 2;
  sweep.color.a = 0.4F;
  for (const core::Rectangle& front : sweepOf(model)) addOutline(front, &sweep);
  markers->markers.push_back(sweep);

  Marker label = marker(header, "labels", id, Marker::TEXT_VIEW_FACING, colorOf(model));
  label.text = labelOf(model);
  label.pose.position = toPoint(model.predict(model.q).translation());
  label.scale.z = kTextHeight;
  markers->markers.push_back(label);
}

}  // namespace

void addMarkers(const std::vector<core::DetectedRectangle>& rectangles, const std_msgs::Header& header,
                visualization_msgs::MarkerArray* markers) {
  for (size_t i = 0; i < rectangles.size(); ++i) {
    Marker outline = marker(header, "rectangles", static_cast<int>(i), Marker::LINE_LIST, kRectangleColor);
    addOutline(rectangles[i].rectangle, &outline);
    markers->markers.push_back(outline);
  }
}

void addMarkers(const std::vector<core::LearnedModel>& models, const std_msgs::Header& header,
                visualization_msgs::MarkerArray* markers) {
  for (const core::LearnedModel& model : models) {
    Marker front = marker(header, "fronts", static_cast<int>(model.id), Marker::LINE_LIST, colorOf(model));
    front.scale.x = 2 * kLineWidth;
    addOutline(frontAt(model, model.q), &front);
    markers->markers.push_back(front);
    if (isJoint(model)) addJoint(model, header, markers);
  }
}

void MarkerHistory::deleteVanished(visualization_msgs::MarkerArray* markers) {
  std::set<Key> now;
  for (const Marker& marker : markers->markers) now.emplace(marker.ns, marker.id);
  for (const Key& key : shown_) {
    if (now.count(key)) continue;
    Marker gone;
    gone.ns = key.first;
    gone.id = key.second;
    gone.action = Marker::DELETE;
    gone.pose.orientation.w = 1;
    markers->markers.push_back(gone);
  }
  shown_ = now;
}

}  // namespace cabinet_articulation
