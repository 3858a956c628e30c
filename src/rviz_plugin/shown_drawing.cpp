// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/shown_drawing.h"

#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreResourceGroupManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreTechnique.h>

#include <atomic>

namespace cabinet_articulation {
namespace {

constexpr float kSeeThrough = 0.5F;  ///< any opacity below 1 lets billboards blend the colours of their points

Ogre::Vector3 toOgre(const Eigen::Vector3d& p) {
  const Eigen::Vector3f f = p.cast<float>();
  return {f.x(), f.y(), f.z()};
}

Ogre::ColourValue toOgre(const Paint& paint) {
  return Ogre::ColourValue(paint.color[0], paint.color[1], paint.color[2], paint.alpha);
}

/// Colours of the vertices, seen from both sides; what is see-through hides nothing behind it.
Ogre::MaterialPtr makeMaterial() {
  static std::atomic<unsigned> made{0};
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      "cabinet_articulation_" + std::to_string(made++), Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->setReceiveShadows(false);
  material->setCullingMode(Ogre::CULL_NONE);
  material->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  material->setDepthWriteEnabled(false);
  material->getTechnique(0)->setLightingEnabled(false);
  return material;
}

}  // namespace

ShownDrawing::ShownDrawing(Ogre::SceneManager* scene, Ogre::SceneNode* parent)
    : scene_(scene),
      node_(parent->createChildSceneNode()),
      material_(makeMaterial()),
      surfaces_(scene->createManualObject()),
      thin_lines_(scene->createManualObject()) {
  node_->attachObject(surfaces_);
  node_->attachObject(thin_lines_);
}

ShownDrawing::~ShownDrawing() {
  clear();
  scene_->destroyManualObject(surfaces_);
  scene_->destroyManualObject(thin_lines_);
  scene_->destroySceneNode(node_);
  Ogre::ResourcePtr material = material_;
  Ogre::MaterialManager::getSingleton().remove(material);
}

void ShownDrawing::clear() {
  surfaces_->clear();
  thin_lines_->clear();
  wide_lines_.reset();
  texts_.clear();
  for (Ogre::SceneNode* node : text_nodes_) scene_->destroySceneNode(node);
  text_nodes_.clear();
}

void ShownDrawing::show(const Drawing& drawing, const LineStyle& style) {
  clear();
  showTriangles(drawing.triangles);
  if (style.width > 0) {
    showWideLines(drawing.lines, style.width);
  } else {
    showThinLines(drawing.lines);
  }
  showTexts(drawing.texts, style.text_height);
}

void ShownDrawing::showTriangles(const std::vector<DrawnTriangle>& triangles) {
  if (triangles.empty()) return;
  surfaces_->estimateVertexCount(3 * triangles.size());
  surfaces_->begin(material_->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST, material_->getGroup());
  for (const DrawnTriangle& triangle : triangles) {
    for (const Eigen::Vector3d& corner : triangle.corners) {
      surfaces_->position(toOgre(corner));
      surfaces_->colour(toOgre(triangle.paint));
    }
  }
  surfaces_->end();
}

void ShownDrawing::showThinLines(const std::vector<DrawnLine>& lines) {
  if (lines.empty()) return;
  thin_lines_->begin(material_->getName(), Ogre::RenderOperation::OT_LINE_LIST, material_->getGroup());
  for (const DrawnLine& line : lines) {
    for (const Eigen::Vector3d& end : {line.from, line.to}) {
      thin_lines_->position(toOgre(end));
      thin_lines_->colour(toOgre(line.paint));
    }
  }
  thin_lines_->end();
}

void ShownDrawing::showWideLines(const std::vector<DrawnLine>& lines, float width) {
  if (lines.empty()) return;
  wide_lines_ = std::make_unique<rviz::BillboardLine>(scene_, node_);
  wide_lines_->setMaxPointsPerLine(2);
  wide_lines_->setNumLines(static_cast<std::uint32_t>(lines.size()));
  wide_lines_->setLineWidth(width);
  wide_lines_->setColor(1, 1, 1, kSeeThrough);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i > 0) wide_lines_->newLine();
    wide_lines_->addPoint(toOgre(lines[i].from), toOgre(lines[i].paint));
    wide_lines_->addPoint(toOgre(lines[i].to), toOgre(lines[i].paint));
  }
}

void ShownDrawing::showTexts(const std::vector<DrawnText>& texts, float height) {
  for (const DrawnText& text : texts) {
    auto shown = std::make_unique<rviz::MovableText>(text.text, "Liberation Sans", height, toOgre(text.paint));
    shown->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_CENTER);
    shown->showOnTop();
    text_nodes_.push_back(node_->createChildSceneNode(toOgre(text.at)));
    text_nodes_.back()->attachObject(shown.get());
    texts_.push_back(std::move(shown));
  }
}

void ShownDrawing::place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation) {
  node_->setPosition(position);
  node_->setOrientation(orientation);
}

void ShownDrawing::setVisible(bool visible) { node_->setVisible(visible); }

}  // namespace cabinet_articulation
