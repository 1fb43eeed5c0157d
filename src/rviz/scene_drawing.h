// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <OgreMaterial.h>

#include "datmo_fusion/ros/display/drawing.h"

namespace Ogre {
class ManualObject;
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace rviz {
class MovableText;
}  // namespace rviz

namespace datmo {

/// Shows a Drawing in rviz's scene, below a node: all triangles as two objects with three
/// batches.
class SceneDrawing {
 public:
  /// Both must outlive this.
  SceneDrawing(Ogre::SceneManager& scene, Ogre::SceneNode& parent);
  ~SceneDrawing();
  SceneDrawing(const SceneDrawing&) = delete;
  SceneDrawing& operator=(const SceneDrawing&) = delete;

  /// Replaces what was shown before.
  void show(const Drawing& drawing);

  void clear() { show(Drawing()); }

 private:
  struct Label {
    Ogre::SceneNode* node = nullptr;
    std::unique_ptr<rviz::MovableText> text;
  };

  static void addBatch(const std::vector<DrawnVertex>& vertices, const Ogre::MaterialPtr& material,
                       Ogre::ManualObject& object);
  void showLabels(const std::vector<DrawnLabel>& labels);

  Ogre::SceneManager& scene_;
  Ogre::SceneNode* node_;
  Ogre::ManualObject* triangles_;
  Ogre::ManualObject* meshes_;  ///< translucent, drawn after all other translucent objects
  Ogre::MaterialPtr solid_;
  Ogre::MaterialPtr translucent_;
  Ogre::MaterialPtr front_;    ///< translucent, without what is behind the front
  std::vector<Label> labels_;  ///< those beyond the shown ones are hidden
};

}  // namespace datmo
