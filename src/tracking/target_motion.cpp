// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/target_motion.h"

#include <cmath>

namespace datmo {

namespace {

/// rad; below this angle the series are exact to double precision, and the quotients are not.
constexpr double kSmallAngle = 1e-3;

/// The integrals of a turning velocity, without division by a small angle.
struct TurnSeries {
  double sine;        ///< sin a / a
  double cosine;      ///< (1 - cos a) / a^2
  double sine_third;  ///< (a - sin a) / a^3
};

TurnSeries turnSeries(double angle) {
  const double square = angle * angle;
  if (std::abs(angle) < kSmallAngle) {
    return {1.0 - square / 6.0, 0.5 - square / 24.0, 1.0 / 6.0 - square / 120.0};
  }
  return {std::sin(angle) / angle, (1.0 - std::cos(angle)) / square,
          (angle - std::sin(angle)) / (square * angle)};
}

/// The 2 x 2 matrix that multiplies by the complex number `real + i imaginary`.
Eigen::Matrix2d complexMatrix(double real, double imaginary) {
  Eigen::Matrix2d matrix;
  matrix << real, -imaginary, imaginary, real;
  return matrix;
}

/// Transforms position, velocity and unmodeled acceleration to the state.
TrackCovariance withCentripetal(double turn_rate) {
  TrackCovariance matrix = TrackCovariance::Identity();
  matrix.block<2, 2>(4, 2) = complexMatrix(0.0, turn_rate);
  return matrix;
}

}  // namespace

void TargetMotionOptions::visit(OptionVisitor& visitor) {
  visitor.number({"turn_rate", "rad/s",
                  "turn rate of the left and the right turn model; a car at a crossing turns at "
                  "0.3 to 0.6 (8 m/s on a radius of 15 to 25 m), a cyclist at 0.6 (4 m/s on 6 m to "
                  "7 m), a pedestrian at 0.75 (1.3 m/s, 1 m/s^2 lateral)"},
                 turn_rate, {0.05, 2.0});
  visitor.number({"acceleration_density", "m^2/s^3",
                  "power of the white acceleration of the constant velocity and turn models "
                  "(Bar-Shalom et al. 2001, 6.2.2): its root is the change of speed in one second; "
                  "for pedestrians, twice the variance of their speeds, 0.26 m/s (Weidmann 1993), "
                  "over the 0.5 s for which they keep them (Helbing and Molnar 1995)"},
                 acceleration_density, {1e-6, 100.0});
  visitor.number({"jerk_density", "m^2/s^5",
                  "power of the white jerk of the constant acceleration model (ibid., 6.2.3): its "
                  "root is the change of acceleration in one second"},
                 jerk_density, {1e-6, 100.0});
  visitor.number({"acceleration_std", "m/s^2",
                  "standard deviation of the acceleration that the constant velocity and turn "
                  "models do not explain"},
                 acceleration_std, {1e-3, 10.0});
  visitor.number(
      {"acceleration_fading", "s", "time constant with which these models forget an acceleration"},
      acceleration_fading, {1e-2, 10.0});
  visitor.number({"standing_speed_std", "m/s",
                  "standard deviation of the velocity in the standing model; also of its "
                  "acceleration, in m/s^2"},
                 standing_speed_std, {1e-3, 1.0});
  visitor.number({"standing_density", "m^2/s",
                  "power of the random walk of a stationary object's position: its root is the "
                  "change in one second"},
                 standing_density, {0.0, 1.0});
  visitor.number({"start_speed_std", "m/s",
                  "standard deviation of each component of the velocity of an object that starts "
                  "to move, in the scan in which it does; three times this for one that stops"},
                 start_speed_std, {1e-2, 10.0});
}

TargetMotionOptions pedestrianMotion() {
  TargetMotionOptions options;
  options.turn_rate = 0.75;
  options.acceleration_density = 0.27;
  return options;
}

TargetMotionOptions cyclistMotion() {
  TargetMotionOptions options;
  options.turn_rate = 0.6;
  return options;
}

LinearMotion coordinatedTurn(double turn_rate, const TargetMotionOptions& options, double seconds) {
  const double angle = turn_rate * seconds;
  const TurnSeries series = turnSeries(angle);
  const double kept = std::exp(-seconds / options.acceleration_fading);

  TrackCovariance transition = TrackCovariance::Identity();
  transition.block<2, 2>(0, 2) =
      complexMatrix(series.sine * seconds, series.cosine * angle * seconds);
  transition.block<2, 2>(2, 2) = complexMatrix(std::cos(angle), std::sin(angle));
  transition.block<2, 2>(4, 4) *= kept;

  const double power = options.acceleration_density * seconds;
  TrackCovariance noise = TrackCovariance::Zero();
  noise.block<2, 2>(0, 0) =
      Eigen::Matrix2d::Identity() * (2.0 * power * seconds * seconds * series.sine_third);
  noise.block<2, 2>(0, 2) =
      complexMatrix(power * seconds * series.cosine, -power * seconds * angle * series.sine_third);
  noise.block<2, 2>(2, 0) = noise.block<2, 2>(0, 2).transpose();
  noise.block<2, 2>(2, 2) = Eigen::Matrix2d::Identity() * power;
  noise.block<2, 2>(4, 4) = Eigen::Matrix2d::Identity() * options.acceleration_std *
                            options.acceleration_std * (1.0 - kept * kept);

  const TrackCovariance add = withCentripetal(turn_rate);
  const TrackCovariance remove = withCentripetal(-turn_rate);
  return {add * transition * remove, add * noise * add.transpose()};
}

LinearMotion constantAcceleration(const TargetMotionOptions& options, double seconds) {
  const double t = seconds;
  const Eigen::Matrix2d identity = Eigen::Matrix2d::Identity();
  LinearMotion motion{TrackCovariance::Identity(), TrackCovariance::Zero()};
  motion.transition.block<2, 2>(0, 2) = identity * t;
  motion.transition.block<2, 2>(0, 4) = identity * (t * t / 2.0);
  motion.transition.block<2, 2>(2, 4) = identity * t;

  Eigen::Matrix3d axis;
  axis << std::pow(t, 5) / 20.0, std::pow(t, 4) / 8.0, std::pow(t, 3) / 6.0,  //
      std::pow(t, 4) / 8.0, std::pow(t, 3) / 3.0, t * t / 2.0,                //
      std::pow(t, 3) / 6.0, t * t / 2.0, t;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      motion.noise.block<2, 2>(2 * row, 2 * column) =
          identity * (options.jerk_density * axis(row, column));
    }
  }
  return motion;
}

LinearMotion standingStill(const TargetMotionOptions& options, double seconds) {
  const double kept = std::exp(-seconds / options.standing_fading);
  const double rest = options.standing_speed_std * options.standing_speed_std;
  LinearMotion motion{TrackCovariance::Identity(), TrackCovariance::Zero()};
  motion.transition.diagonal().tail<4>().setConstant(kept);
  motion.noise.diagonal().head<2>().setConstant(options.standing_density * seconds);
  motion.noise.diagonal().tail<4>().setConstant(rest * (1.0 - kept * kept));
  return motion;
}

TrackState startVariance(const TargetMotionOptions& options) {
  const double speed = options.start_speed_std * options.start_speed_std;
  const double acceleration = options.acceleration_std * options.acceleration_std;
  TrackState variance;
  variance << 0.0, 0.0, speed, speed, acceleration, acceleration;
  return variance;
}

std::array<LinearMotion, kMotionModes> targetMotions(const TargetMotionOptions& options,
                                                     double seconds) {
  return {coordinatedTurn(0.0, options, seconds), constantAcceleration(options, seconds),
          coordinatedTurn(options.turn_rate, options, seconds),
          coordinatedTurn(-options.turn_rate, options, seconds), standingStill(options, seconds)};
}

}  // namespace datmo
