// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "datmo_fusion/common/options.h"
#include "datmo_fusion/slam/twist_gate.h"

namespace datmo {

/// Source of the vehicle's motion, for all stages: section `motion` of a sensor set.
struct MotionOptions {
  std::string source = "odometry";
  bool odometry_pose = false;
  double hold = 0.5;          ///< s
  double wheel_radius = 0.3;  ///< m
  TwistGateOptions change;

  void visit(OptionVisitor& visitor);

  /// nav_msgs/Odometry of the vehicle itself, with poses and its own odom -> base on tf.
  bool fromOdometry() const { return source == "odometry"; }
  /// A twist is put together from other sensors (MotionStage).
  bool fromSensors() const { return source != "odometry" && source != "none"; }
  /// Without it the yaw rate alone is known.
  bool hasSpeed() const { return source != "none" && source != "imu"; }

  bool usesImu() const { return source.rfind("imu", 0) == 0; }
  bool usesTwist() const { return source == "twist" || source == "imu_and_twist"; }
  bool usesWheels() const { return source == "imu_and_wheels"; }

  /// Where the stages read the odometry: the vehicle's own, or what MotionStage makes.
  std::string odometryTopic() const { return fromSensors() ? "motion/odometry" : "odometry"; }
};

}  // namespace datmo
