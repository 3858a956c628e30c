// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <rviz/display.h>
#include <std_msgs/Header.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "rviz_plugin/display_colors.h"
#include "rviz_plugin/latest_message.h"
#include "rviz_plugin/shown_drawing.h"

namespace rviz {
class EnumProperty;
class FloatProperty;
class RosTopicProperty;
}  // namespace rviz

namespace cabinet_articulation {

/// What the displays have in common: colours, lines, the end of what nobody tells any more, and where a frame is.
class SceneDisplay : public rviz::Display {
  Q_OBJECT

 public:
  SceneDisplay();

  void reset() override;
  void update(float wall_dt, float ros_dt) override;

 protected:
  void onEnable() override;
  void onDisable() override;

  virtual void subscribe() = 0;
  virtual void unsubscribe() = 0;

  /// Forgets all messages and what statuses say of them; what is drawn goes with the next redraw().
  virtual void forget() = 0;

  /// After messages or settings changed.
  virtual void redraw() = 0;

  /// In every frame of RViz: where the drawings are now, and what the statuses say.
  virtual void follow() = 0;

  rviz::RosTopicProperty* addTopic(const QString& name, const QString& topic, const std::string& type,
                                   const QString& description);
  ColorBy colorBy() const;
  LineStyle lineStyle() const;
  double timeout() const;

  /// Takes a message. What it throws is said under the name `status`, until the next one is taken.
  template <class Take>
  void takeOrRefuse(const QString& status, const Take& take) {
    try {
      take();
      deleteStatus(status);
      changed();
    } catch (const std::invalid_argument& error) {
      setStatus(rviz::StatusProperty::Error, status, error.what());
    }
  }

  /// Puts a drawing where its frame is, and hides it where tf does not know. Tries the time of the header first and then the
  /// newest transform, so that nothing flickers while tf is late. `status` is the name under which it says what is missing.
  void place(const std_msgs::Header& header, const QString& status, ShownDrawing* drawing);

 protected Q_SLOTS:
  void changed() { dirty_ = true; }
  void resubscribe();

 private:
  rviz::EnumProperty* color_by_;
  rviz::FloatProperty *line_width_, *text_height_, *timeout_;
  bool dirty_ = false;
};

}  // namespace cabinet_articulation
