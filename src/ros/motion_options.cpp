// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/ros/motion_options.h"

namespace datmo {

void MotionOptions::visit(OptionVisitor& visitor) {
  visitor.choice({"source", "",
                  "source of the vehicle's motion: its odometry (nav_msgs/Odometry); a twist "
                  "(TwistStamped, TwistWithCovarianceStamped); the yaw rate of an Imu, with the "
                  "speed from the scans; that yaw rate and the speed of a twist or of the wheels "
                  "(JointState); or none: all from the scans",
                  Tier::kPublic},
                 source,
                 {{"odometry", MotionSource::kOdometry},
                  {"twist", MotionSource::kTwist},
                  {"imu", MotionSource::kImu},
                  {"imu_and_twist", MotionSource::kImuAndTwist},
                  {"imu_and_wheels", MotionSource::kImuAndWheels},
                  {"none", MotionSource::kNone}});
  visitor.toggle({"odometry_pose", "",
                  "take the motion from the odometry's poses, for a robot's wheel encoders; false: "
                  "from its speed and yaw rate",
                  Tier::kPublic},
                 odometry_pose);
  visitor.number({"hold", "s",
                  "how long the last odometry, or speed used with an Imu, is held when no newer "
                  "one arrives; after that the pose is predicted with the last estimated velocity",
                  Tier::kPublic},
                 hold, {0.0, 10.0});
  visitor.number({"wheel_radius", "m",
                  "imu_and_wheels: the speed is this times the mean velocity of the JointState",
                  Tier::kPublic},
                 wheel_radius, {0.001, 5.0});
  noise.visit(visitor);
  change.visit(visitor);
}

}  // namespace datmo
