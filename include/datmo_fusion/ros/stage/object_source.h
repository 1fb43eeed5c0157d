// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include <boost/make_shared.hpp>

#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>

#include "datmo_fusion/common/object.h"
#include "datmo_fusion/ros/convert/message_conversion.h"
#include "datmo_fusion/ros/convert/messages.h"
#include "datmo_fusion/ros/frame_options.h"
#include "datmo_fusion/ros/stage/motion_input.h"
#include "datmo_fusion/ros/stage/stage.h"
#include "datmo_fusion/ros/stage/stage_inputs.h"
#include "datmo_fusion/ros/stage/stage_runner.h"
#include "datmo_fusion/ros/transform_buffer.h"

namespace datmo {

/// Base of stages that detect objects in each message of one sensor, using the vehicle's motion:
/// one more source for object_fusion. `sensor` (radar) is the topic of its messages, and the
/// objects are published on objects/radar. Bad input is dropped or warned about, with a report to
/// the monitor, never thrown. A derived stage adds the detection.
template <typename Message>
class ObjectSource : public Stage {
 public:
  void handleOdometry(const nav_msgs::Odometry& message) { handleMotion(message); }
  void handlePose(const geometry_msgs::PoseWithCovarianceStamped& message) {
    handleMotion(message);
  }

  /// Returns objects in the vehicle's frame at the message's stamp; null if the message was
  /// dropped.
  ObjectArrayPtr handle(const Message& message) {
    return runner_.serve(sensor_, message, [&] {
      const ObjectList objects = detect(message);
      auto array = boost::make_shared<ObjectArray>(toMessage(objects, frames_.base));
      runner_.processed(objects.stamp);
      return array;
    });
  }

  void connect(StagePorts& ports) override {
    const auto objects = ports.out<ObjectArray>("objects/" + sensor_);
    connectMotion(ports, motion_options_, *this);
    ports.in<Message>(sensor_, [this, objects](const auto& message, Stamp /*now*/) {
      objects.publish(handle(*message));
    });
  }

 protected:
  /// `transforms` and `monitor` must outlive the stage.
  template <typename Options>
  ObjectSource(std::string sensor, const Options& options, const TransformBuffer& transforms,
               StageMonitor& monitor)
      : frames_(options.frames),
        transforms_(transforms),
        monitor_(monitor),
        runner_(monitor, options.input, "starts over", [this] { motion_.reset(); }),
        motion_(options.motion, options.frames, runner_),
        sensor_(std::move(sensor)),
        motion_options_(options.motion) {}

  /// Objects in the vehicle's frame at the message's stamp. Throws InputError if the message is
  /// bad.
  virtual ObjectList detect(const Message& message) = 0;

  /// To be called by detect() after all other checks of the message (StageRunner::check).
  void checkStamp(const Message& message) { runner_.check(sensor_, message.header.stamp); }

  FrameOptions frames_;
  const TransformBuffer& transforms_;
  StageMonitor& monitor_;
  StageRunner runner_;
  MotionInput motion_;

 private:
  template <typename MotionMessage>
  void handleMotion(const MotionMessage& message) {
    runner_.serve([&] { motion_.update(message); });
  }

  std::string sensor_;
  MotionOptions motion_options_;
};

}  // namespace datmo
