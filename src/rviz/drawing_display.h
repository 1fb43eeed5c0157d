// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <memory>
#include <string>

#include "scene_drawing.h"
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/message_filter_display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>

namespace datmo {

/// What the master says is published on a topic, if it is not `expected`; else empty.
std::string otherType(const std::string& topic, const std::string& expected);

/// A display that draws the newest message of a topic, by the markers that it makes of it, and
/// draws it again when a property changes.
///
/// Properties belong to the display (Qt) and report by lambdas: no class needs Qt's compiler.
/// Messages come in the window's thread alone.
template <typename Message>
class DrawingDisplay : public rviz::MessageFilterDisplay<Message> {
 public:
  using Base = rviz::MessageFilterDisplay<Message>;

  void reset() override {
    Base::reset();
    last_.reset();
    if (scene_) {
      scene_->clear();
    }
  }

 protected:
  /// In one frame: the message's. May throw.
  virtual visualization_msgs::MarkerArray draw(const Message& message) const = 0;

  void onInitialize() override {
    Base::onInitialize();
    scene_ = std::make_unique<SceneDrawing>(*this->context_->getSceneManager(), *this->scene_node_);
  }

  void subscribe() override {
    Base::subscribe();
    const std::string topic = this->topic_property_->getTopicStd();
    const std::string expected = ros::message_traits::datatype<Message>();
    const std::string other = this->isEnabled() ? otherType(topic, expected) : "";
    if (!other.empty()) {
      this->setStatusStd(rviz::StatusProperty::Error, "Topic",
                         topic + " is " + other + ": expected " + expected);
    }
  }

  void processMessage(const typename Message::ConstPtr& message) override {
    last_ = message;
    redraw();
  }

  /// Draws the last message again.
  void redraw() {
    if (!last_ || !scene_) {
      return;
    }
    Ogre::Vector3 position;
    Ogre::Quaternion orientation;
    const std_msgs::Header& header = last_->header;
    if (!this->context_->getFrameManager()->getTransform(header.frame_id, header.stamp, position,
                                                         orientation)) {
      this->setStatusStd(rviz::StatusProperty::Error, "Transform",
                         "no transform from '" + header.frame_id + "' to '" +
                             this->fixed_frame_.toStdString() + "' at the message's time");
      return;
    }
    this->setStatusStd(rviz::StatusProperty::Ok, "Transform", "OK");
    this->scene_node_->setPosition(position);
    this->scene_node_->setOrientation(orientation);
    try {
      scene_->show(drawingOf(draw(*last_)));
      this->setStatusStd(rviz::StatusProperty::Ok, "Message", "OK");
    } catch (const std::exception& error) {
      scene_->clear();
      this->setStatusStd(rviz::StatusProperty::Error, "Message", error.what());
    }
    this->context_->queueRender();
  }

  /// Properties of this display; a change draws again.
  rviz::BoolProperty* toggle(const char* name, bool value, const char* description) {
    return watched(new rviz::BoolProperty(name, value, description, this));
  }

  struct Range {
    float min;
    float max;
  };

  rviz::FloatProperty* number(const char* name, double value, Range range,
                              const char* description) {
    auto* property = new rviz::FloatProperty(name, static_cast<float>(value), description, this);
    property->setMin(range.min);
    property->setMax(range.max);
    return watched(property);
  }

  template <typename Property>
  Property* watched(Property* property) {
    QObject::connect(property, &rviz::Property::changed, this, [this] { redraw(); });
    return property;
  }

 private:
  typename Message::ConstPtr last_;
  std::unique_ptr<SceneDrawing> scene_;
};

/// Leaves out the markers of some namespaces.
template <typename IsShown>
visualization_msgs::MarkerArray onlyShown(visualization_msgs::MarkerArray markers,
                                          const IsShown& is_shown) {
  auto& list = markers.markers;
  list.erase(std::remove_if(list.begin(), list.end(),
                            [&](const auto& marker) { return !is_shown(marker.ns); }),
             list.end());
  return markers;
}

}  // namespace datmo
