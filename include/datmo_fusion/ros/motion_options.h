// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/slam/twist_gate.h"

namespace datmo {

/// Source of the vehicle's motion.
enum class MotionSource { kOdometry, kTwist, kImu, kImuAndTwist, kImuAndWheels, kNone };

/// The vehicle's motion, for all stages: section `motion` of a sensor set.
struct MotionOptions {
  MotionSource source = MotionSource::kOdometry;
  bool odometry_pose = false;
  double hold = 0.5;          ///< s
  double wheel_radius = 0.3;  ///< m
  OdometryNoiseOptions noise;
  TwistGateOptions change;

  void visit(OptionVisitor& visitor);

  /// nav_msgs/Odometry of the vehicle, with poses and its own odom -> base on tf.
  bool fromOdometry() const { return source == MotionSource::kOdometry; }
  /// The twist is combined from other sensors (MotionStage).
  bool fromSensors() const {
    return source != MotionSource::kOdometry && source != MotionSource::kNone;
  }
  /// Otherwise only the yaw rate is known.
  bool hasSpeed() const { return source != MotionSource::kNone && source != MotionSource::kImu; }

  bool usesImu() const {
    return source == MotionSource::kImu || source == MotionSource::kImuAndTwist || usesWheels();
  }
  bool usesTwist() const {
    return source == MotionSource::kTwist || source == MotionSource::kImuAndTwist;
  }
  bool usesWheels() const { return source == MotionSource::kImuAndWheels; }

  /// Topic from which the stages read odometry: the vehicle's own, or that of MotionStage.
  std::string odometryTopic() const { return fromSensors() ? "motion/odometry" : "odometry"; }
};

}  // namespace datmo
