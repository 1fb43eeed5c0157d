// SPDX-License-Identifier: BSD-3-Clause
#include "scene_drawing.h"

#include <algorithm>
#include <atomic>
#include <string>

#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreResourceGroupManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreTechnique.h>
#include <rviz/ogre_helpers/movable_text.h>

namespace datmo {

namespace {

Ogre::Vector3 toOgre(const Eigen::Vector3f& vector) { return {vector.x(), vector.y(), vector.z()}; }

Ogre::ColourValue toOgre(const std_msgs::ColorRGBA& color) {
  return Ogre::ColourValue(color.r, color.g, color.b, color.a);
}

/// Uses the vertex colors, which include lighting.
Ogre::MaterialPtr makeMaterial(const std::string& name, bool translucent) {
  Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      name, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->setReceiveShadows(false);
  material->setCullingMode(Ogre::CULL_NONE);
  material->getTechnique(0)->setLightingEnabled(false);
  if (translucent) {
    material->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
    material->setDepthWriteEnabled(false);
  }
  return material;
}

/// Blends the front only: a first pass finds its depth, so that the inside of a mesh is not seen.
Ogre::MaterialPtr makeFrontMaterial(const std::string& name) {
  Ogre::MaterialPtr material = makeMaterial(name, false);
  Ogre::Technique& technique = *material->getTechnique(0);
  technique.getPass(0)->setColourWriteEnabled(false);
  Ogre::Pass& blended = *technique.createPass();
  blended.setLightingEnabled(false);
  blended.setCullingMode(Ogre::CULL_NONE);
  blended.setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  blended.setDepthWriteEnabled(false);
  return material;
}

std::string uniqueName() {
  static std::atomic<unsigned> count{0};
  return "datmo_fusion/drawing" + std::to_string(count++);
}

}  // namespace

SceneDrawing::SceneDrawing(Ogre::SceneManager& scene, Ogre::SceneNode& parent)
    : scene_(scene), node_(parent.createChildSceneNode()) {
  const std::string name = uniqueName();
  triangles_ = scene_.createManualObject(name);
  meshes_ = scene_.createManualObject(name + "/meshes");
  meshes_->setRenderQueueGroup(Ogre::RENDER_QUEUE_MAIN + 1);
  for (Ogre::ManualObject* object : {triangles_, meshes_}) {
    object->setDynamic(true);
    node_->attachObject(object);
  }
  solid_ = makeMaterial(name + "/solid", false);
  translucent_ = makeMaterial(name + "/translucent", true);
  front_ = makeFrontMaterial(name + "/front");
}

SceneDrawing::~SceneDrawing() {
  for (Label& label : labels_) {
    label.node->detachAllObjects();
    label.text.reset();
    scene_.destroySceneNode(label.node);
  }
  node_->detachAllObjects();
  scene_.destroyManualObject(triangles_);
  scene_.destroyManualObject(meshes_);
  scene_.destroySceneNode(node_);
  for (const Ogre::MaterialPtr& material : {solid_, translucent_, front_}) {
    Ogre::MaterialManager::getSingleton().remove(material->getHandle());
  }
}

void SceneDrawing::show(const Drawing& drawing) {
  triangles_->clear();
  meshes_->clear();
  addBatch(drawing.solid, solid_, *triangles_);
  addBatch(drawing.translucent, translucent_, *triangles_);
  addBatch(drawing.meshes, front_, *meshes_);
  showLabels(drawing.labels);
}

void SceneDrawing::addBatch(const std::vector<DrawnVertex>& vertices,
                            const Ogre::MaterialPtr& material, Ogre::ManualObject& object) {
  if (vertices.empty()) {
    return;
  }
  object.estimateVertexCount(vertices.size());
  object.begin(material->getName(), Ogre::RenderOperation::OT_TRIANGLE_LIST);
  for (const DrawnVertex& vertex : vertices) {
    object.position(toOgre(vertex.position));
    object.colour(toOgre(vertex.color));
  }
  object.end();
}

void SceneDrawing::showLabels(const std::vector<DrawnLabel>& labels) {
  while (labels_.size() < labels.size()) {
    Label label;
    label.node = node_->createChildSceneNode();
    // A blank text would have no bounding box, and be culled forever.
    label.text = std::make_unique<rviz::MovableText>("-");
    label.text->setTextAlignment(rviz::MovableText::H_CENTER, rviz::MovableText::V_CENTER);
    label.node->attachObject(label.text.get());
    labels_.push_back(std::move(label));
  }
  for (std::size_t i = 0; i < labels_.size(); ++i) {
    const bool shown = i < labels.size() && !labels[i].text.empty();
    labels_[i].node->setVisible(shown);
    if (shown) {
      labels_[i].node->setPosition(toOgre(labels[i].position));
      labels_[i].text->setCaption(labels[i].text);
      labels_[i].text->setCharacterHeight(labels[i].height);
      labels_[i].text->setColor(toOgre(labels[i].color));
    }
  }
}

}  // namespace datmo
