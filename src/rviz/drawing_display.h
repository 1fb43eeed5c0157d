// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <exception>
#include <memory>
#include <string>

#include "display_status.h"
#include "scene_drawing.h"
#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/message_filter_display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/float_property.h>

namespace datmo {

/// A display that draws the newest message of a topic as markers, and redraws it when a property
/// changes.
///
/// Its status has rviz's lines "Topic" (publisher, type, messages) and "Transform", and "Message"
/// (the newest one: drawn, or why not) and "Refused" (number, and reason for the last one).
///
/// Properties belong to the display (Qt) and report by lambdas, so no class needs Qt's moc.
/// Messages are received only in the window's thread.
template <typename Message>
class DrawingDisplay : public rviz::MessageFilterDisplay<Message> {
 public:
  using Base = rviz::MessageFilterDisplay<Message>;

  void reset() override {
    Base::reset();
    last_.reset();
    messages_ = {};
    if (scene_) {
      scene_->clear();
    }
  }

  void update(float wall_step, float ros_step) override {
    Base::update(wall_step, ros_step);
    since_status_ += wall_step;
    if (since_status_ >= kStatusPeriod) {
      since_status_ = 0.0F;
      showStatus();
    }
  }

 protected:
  /// Returns markers in the message's frame only. May throw.
  virtual visualization_msgs::MarkerArray draw(const Message& message) const = 0;

  void onInitialize() override {
    Base::onInitialize();
    scene_ = std::make_unique<SceneDrawing>(*this->context_->getSceneManager(), *this->scene_node_);
  }

  void processMessage(const typename Message::ConstPtr& message) override {
    last_ = message;
    messages_.addReceived();
    redraw();
  }

  /// Draws the last message again.
  void redraw() {
    if (!last_ || !scene_) {
      return;
    }
    if (placeScene()) {
      drawLast();
    }
    set("Message", messages_.newest());
    set("Refused", messages_.refused());
    this->context_->queueRender();
  }

  /// Creates a property of this display; a change redraws.
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

  void set(const char* name, const StatusLine& line) {
    this->setStatusStd(line.level, name, line.text);
  }

  Meshes meshes_;  ///< which draw() may refer to

 private:
  /// s, between checks for publishers; connecting takes less.
  static constexpr float kStatusPeriod = 1.0F;

  void showStatus() {
    // Without a subscriber rviz's own line says why: the topic's name is invalid.
    if (const ros::Subscriber& subscriber = this->sub_.getSubscriber()) {
      set("Topic", TopicStatus{this->topic_property_->getTopicStd(),
                               ros::message_traits::datatype<Message>(),
                               subscriber.getNumPublishers(), this->messages_received_}
                       .line());
    }
    set("Message", messages_.newest());
  }

  /// Moves the scene to the last message's frame at its time; false: unknown, which the status
  /// shows.
  bool placeScene() {
    rviz::FrameManager& frames = *this->context_->getFrameManager();
    const std_msgs::Header& header = last_->header;
    Ogre::Vector3 position;
    Ogre::Quaternion orientation;
    if (!frames.getTransform(header, position, orientation)) {
      std::string reason;
      frames.transformHasProblems(header.frame_id, header.stamp, reason);
      set("Transform",
          {rviz::StatusProperty::Error, "no transform from '" + header.frame_id + "' to '" +
                                            this->fixed_frame_.toStdString() + "': " + reason});
      return false;
    }
    set("Transform", {rviz::StatusProperty::Ok, "OK"});
    this->scene_node_->setPosition(position);
    this->scene_node_->setOrientation(orientation);
    return true;
  }

  void drawLast() {
    try {
      const Drawing drawing = drawingOf(draw(*last_), meshes_);
      scene_->show(drawing);
      messages_.setDrawn(drawing.left_out);
    } catch (const std::exception& error) {
      scene_->clear();
      messages_.setRefused(error.what());
    }
  }

  typename Message::ConstPtr last_;
  MessageStatus messages_;
  float since_status_ = 0.0F;  ///< s
  std::unique_ptr<SceneDrawing> scene_;
};

/// Removes the markers of some namespaces.
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
