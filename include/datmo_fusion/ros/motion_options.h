// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/slam/twist_gate.h"

namespace datmo {

/// What the vehicle's motion is known from.
enum class MotionSource { kOdometry, kTwist, kImu, kImuAndTwist, kImuAndWheels, kNone };

/// Source of the vehicle's motion, for all stages: section `motion` of a sensor set.
struct MotionOptions {
  MotionSource source = MotionSource::kOdometry;
  bool odometry_pose = false;
  double hold = 0.5;          ///< s
  double wheel_radius = 0.3;  ///< m
  OdometryNoiseOptions noise;
  TwistGateOptions change;

  void visit(OptionVisitor& visitor);

  /// nav_msgs/Odometry of the vehicle itself, with poses and its own odom -> base on tf.
  bool fromOdometry() const { return source == MotionSource::kOdometry; }
  /// A twist is put together from other sensors (MotionStage).
  bool fromSensors() const {
    return source != MotionSource::kOdometry && source != MotionSource::kNone;
  }
  /// Without it the yaw rate alone is known.
  bool hasSpeed() const { return source != MotionSource::kNone && source != MotionSource::kImu; }

  bool usesImu() const {
    return source == MotionSource::kImu || source == MotionSource::kImuAndTwist || usesWheels();
  }
  bool usesTwist() const {
    return source == MotionSource::kTwist || source == MotionSource::kImuAndTwist;
  }
  bool usesWheels() const { return source == MotionSource::kImuAndWheels; }

  /// Where the stages read the odometry: the vehicle's own, or what MotionStage makes.
  std::string odometryTopic() const { return fromSensors() ? "motion/odometry" : "odometry"; }
};

}  // namespace datmo
