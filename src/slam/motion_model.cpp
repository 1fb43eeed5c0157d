#include "datmo_fusion/slam/motion_model.h"

#include <cmath>

namespace datmo_fusion {

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
}

VelocityMotionModel::VelocityMotionModel(const MotionModelOptions& options) : options_(options) {
  checkOptions(options);
}

Eigen::Matrix3d VelocityMotionModel::covariance(const Twist2& twist, double seconds) const {
  const double speed_sigma =
      options_.speed_noise + options_.speed_noise_ratio * std::abs(twist.forward_speed);
  const double yaw_rate_sigma =
      options_.yaw_rate_noise + options_.yaw_rate_noise_ratio * std::abs(twist.yaw_rate);
  // A turn that goes wrong at a constant rate also bends the path: half of it, sideways.
  Eigen::Matrix3d noise_to_motion = Eigen::Matrix3d::Zero();
  noise_to_motion(0, 0) = seconds;
  noise_to_motion(1, 1) = seconds;
  noise_to_motion(2, 2) = seconds;
  noise_to_motion(1, 2) = 0.5 * twist.forward_speed * seconds * seconds;
  const Eigen::Vector3d sigma(speed_sigma, options_.side_slip_noise, yaw_rate_sigma);
  return noise_to_motion * sigma.cwiseAbs2().asDiagonal() * noise_to_motion.transpose();
}

}  // namespace datmo_fusion
