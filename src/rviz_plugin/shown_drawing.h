// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <OgreMaterial.h>
#include <rviz/ogre_helpers/billboard_line.h>
#include <rviz/ogre_helpers/movable_text.h>

#include <memory>
#include <vector>

#include "rviz_plugin/drawing.h"

namespace Ogre {
class ManualObject;
}

namespace cabinet_articulation {

struct LineStyle {
  float width = 0.005F;       ///< [m] 0: one pixel, however near the camera is
  float text_height = 0.05F;  ///< [m]
};

/// A drawing in RViz' scene. It is shown as a whole, so that nothing is left of what was drawn before.
class ShownDrawing {
 public:
  ShownDrawing(Ogre::SceneManager* scene, Ogre::SceneNode* parent);
  ~ShownDrawing();
  ShownDrawing(const ShownDrawing&) = delete;
  ShownDrawing& operator=(const ShownDrawing&) = delete;

  void show(const Drawing& drawing, const LineStyle& style);
  void clear();

  /// Places the frame of the drawing in RViz' fixed frame.
  void place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation);
  void setVisible(bool visible);

 private:
  void showThinLines(const std::vector<DrawnLine>& lines);
  void showWideLines(const std::vector<DrawnLine>& lines, float width);
  void showTriangles(const std::vector<DrawnTriangle>& triangles);
  void showTexts(const std::vector<DrawnText>& texts, float height);

  Ogre::SceneManager* scene_;
  Ogre::SceneNode* node_;
  Ogre::MaterialPtr material_;
  Ogre::ManualObject* surfaces_;
  Ogre::ManualObject* thin_lines_;
  std::unique_ptr<rviz::BillboardLine> wide_lines_;
  std::vector<std::unique_ptr<rviz::MovableText>> texts_;
  std::vector<Ogre::SceneNode*> text_nodes_;
};

}  // namespace cabinet_articulation
