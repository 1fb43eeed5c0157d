#include "datmo_fusion/slam/pose_filter.h"

#include <Eigen/LU>

namespace datmo {

void PoseFilterOptions::visit(OptionVisitor& visitor) {
  visitor.toggle(
      {"calibrate_odometry", "",
       "estimate the odometry's scale error and yaw-rate bias on the way; false: take it "
       "as unbiased (thesis)"},
      calibrate_odometry);
  visitor.number({"speed_scale_sigma", "1", "standard deviation of the speed's scale at the start"},
                 speed_scale_sigma, {0.0, 0.5});
  visitor.number(
      {"yaw_rate_bias_sigma", "rad/s", "standard deviation of the yaw rate's bias at the start"},
      yaw_rate_bias_sigma, {0.0, 1.0});
  visitor.number({"speed_scale_drift", "1/s^0.5", "random walk of the speed's scale"},
                 speed_scale_drift, {0.0, 0.1});
  visitor.number({"yaw_rate_bias_drift", "rad/s^1.5", "random walk of the yaw rate's bias"},
                 yaw_rate_bias_drift, {0.0, 0.1});
}

PoseFilter::PoseFilter(const PoseFilterOptions& options, const MotionModelOptions& motion)
    : options_(options), motion_model_(motion) {
  checkOptions(options);
  if (options_.calibrate_odometry) {
    covariance_(3, 3) = options_.speed_scale_sigma * options_.speed_scale_sigma;
    covariance_(4, 4) = options_.yaw_rate_bias_sigma * options_.yaw_rate_bias_sigma;
  }
}

PoseWithCovariance PoseFilter::pose() const { return {pose_, covariance_.topLeftCorner<3, 3>()}; }

void PoseFilter::predict(const Pose2& motion, const Eigen::Matrix3d& motion_noise) {
  const Pose2 next = pose_ * motion;
  // The heading's error turns the motion; the motion's own noise comes on top.
  Covariance transport = Covariance::Identity();
  transport(0, 2) = pose_.y() - next.y();
  transport(1, 2) = next.x() - pose_.x();
  covariance_ = transport * covariance_ * transport.transpose();
  Eigen::Matrix3d to_map = Eigen::Matrix3d::Identity();
  to_map.topLeftCorner<2, 2>() = next.rotation();
  covariance_.topLeftCorner<3, 3>() += to_map * motion_noise * to_map.transpose();
  pose_ = next;
}

void PoseFilter::predictMeasured(const Pose2& motion, double seconds) {
  const Twist2 twist = twistOf(motion, seconds);
  // A larger scale or bias would have meant a shorter motion, and less of a turn; the turn bends
  // the path, so that half of it also moves the vehicle sideways.
  const Point2 along = (pose_ * motion).rotate(Point2(1.0, 0.0));
  const Point2 aside = (pose_ * motion).rotate(Point2(0.0, 1.0));
  const double length = twist.forward_speed * seconds;
  Covariance calibration = Covariance::Identity();
  calibration.block<2, 1>(0, 3) = -length * along / (1.0 + errors_.speed_scale);
  calibration.block<2, 1>(0, 4) = -0.5 * length * seconds * aside;
  calibration(2, 4) = -seconds;
  predict(motion, motion_model_.covariance(twist, seconds));
  covariance_ = calibration * covariance_ * calibration.transpose();
  if (options_.calibrate_odometry) {
    covariance_(3, 3) += options_.speed_scale_drift * options_.speed_scale_drift * seconds;
    covariance_(4, 4) += options_.yaw_rate_bias_drift * options_.yaw_rate_bias_drift * seconds;
  }
}

void PoseFilter::predictUnmeasured(const Pose2& motion, double seconds) {
  predict(motion, motion_model_.covarianceWithoutOdometry(twistOf(motion, seconds), seconds));
}

void PoseFilter::predictUnknown(double seconds) {
  predict(Pose2(), motion_model_.covarianceOfUnknownMotion(seconds));
}

void PoseFilter::correct(const PoseWithCovariance& matched) {
  const Eigen::Matrix3d prior = covariance_.topLeftCorner<3, 3>();
  // What the pose learned, carried over to what is correlated with it.
  const Eigen::Matrix<double, kStates, 3> gain = covariance_.leftCols<3>() * prior.inverse();
  const Eigen::Vector3d learned(matched.pose.x() - pose_.x(), matched.pose.y() - pose_.y(),
                                angleBetween(pose_.heading(), matched.pose.heading()));
  const Eigen::Matrix<double, kStates, 1> step = gain * learned;
  errors_.speed_scale += step[3];
  errors_.yaw_rate_bias += step[4];
  covariance_ -= gain * (prior - matched.covariance) * gain.transpose();
  covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
  pose_ = matched.pose;
}

}  // namespace datmo
