#include "datmo_fusion/slam/motion_model.h"

#include <cmath>

namespace datmo {

void MotionModelOptions::visit(OptionVisitor& visitor) {
  visitor.number({"speed_noise", "m/s", "standard deviation of the speed"}, speed_noise,
                 {0.001, 10.0});
  visitor.number({"speed_noise_ratio", "1", "and of it for each m/s of speed: wheel radius, slip"},
                 speed_noise_ratio, {0.0, 1.0});
  visitor.number({"yaw_rate_noise", "rad/s", "standard deviation of the yaw rate, bias included"},
                 yaw_rate_noise, {0.0001, 3.0});
  visitor.number({"yaw_rate_noise_ratio", "1", "and of it for each rad/s of yaw rate"},
                 yaw_rate_noise_ratio, {0.0, 1.0});
  visitor.number({"side_slip_noise", "m/s", "standard deviation of the speed sideways"},
                 side_slip_noise, {0.0001, 5.0});
  visitor.number({"acceleration_noise", "m/s^2",
                  "without odometry: standard deviation of the acceleration since the last scan"},
                 acceleration_noise, {0.001, 50.0});
  visitor.number(
      {"yaw_acceleration_noise", "rad/s^2",
       "without odometry: standard deviation of the yaw acceleration since the last scan"},
      yaw_acceleration_noise, {0.001, 50.0});
}

VelocityMotionModel::VelocityMotionModel(const MotionModelOptions& options) : options_(options) {
  checkOptions(options);
}

Eigen::Matrix3d VelocityMotionModel::covariance(const Twist2& twist, double seconds,
                                                double speed_sigma, double yaw_rate_sigma) const {
  // A turn that goes wrong at a constant rate also bends the path: half of it, sideways.
  Eigen::Matrix3d noise_to_motion = seconds * Eigen::Matrix3d::Identity();
  noise_to_motion(1, 2) = 0.5 * twist.forward_speed * seconds * seconds;
  const Eigen::Vector3d sigma(speed_sigma, options_.side_slip_noise, yaw_rate_sigma);
  return noise_to_motion * sigma.cwiseAbs2().asDiagonal() * noise_to_motion.transpose();
}

Eigen::Matrix3d VelocityMotionModel::covariance(const Twist2& twist, double seconds) const {
  return covariance(
      twist, seconds,
      options_.speed_noise + options_.speed_noise_ratio * std::abs(twist.forward_speed),
      options_.yaw_rate_noise + options_.yaw_rate_noise_ratio * std::abs(twist.yaw_rate));
}

Eigen::Matrix3d VelocityMotionModel::covarianceWithoutOdometry(const Twist2& twist,
                                                               double seconds) const {
  return covariance(twist, seconds, options_.speed_noise + options_.acceleration_noise * seconds,
                    options_.yaw_rate_noise + options_.yaw_acceleration_noise * seconds);
}

Eigen::Matrix3d VelocityMotionModel::covarianceOfUnknownMotion(double seconds) const {
  return covariance({}, seconds, options_.initial_speed_sigma, options_.initial_yaw_rate_sigma);
}

}  // namespace datmo
