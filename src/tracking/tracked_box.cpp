#include "datmo_fusion/tracking/tracked_box.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace datmo {

namespace {

/// Of the two directions of a line, the one nearer to `reference`.
double nearerDirection(double direction, double reference) {
  return std::cos(direction - reference) < 0.0 ? normalizeAngle(direction + kPi) : direction;
}

/// Whether two directions, as lines, are nearer to a right angle than to each other.
bool isAcross(double a, double b) { return std::abs(std::cos(a - b)) < std::abs(std::sin(a - b)); }

/// The direction of the object's side that runs along `heading`: the longer one seen may be its
/// rear.
double sideAlong(const Object& object, double heading) {
  const double longer = object.box.centre.heading();
  return nearerDirection(isAcross(longer, heading) ? longer + 0.5 * kPi : longer, heading);
}

double share(double seconds, double time_constant) {
  return 1.0 - std::exp(-seconds / time_constant);
}

}  // namespace

void TrackedBoxOptions::visit(OptionVisitor& visitor) {
  visitor.number({"growth_time", "s", "time constant with which the size follows a larger object"},
                 growth_time, {1e-3, 10.0});
  visitor.number({"shrink_time", "s",
                  "time constant with which it follows a smaller one: most often a part of it"},
                 shrink_time, {1e-3, 1000.0});
  visitor.number({"heading_drift", "rad^2/s", "growth of the heading's variance while not seen"},
                 heading_drift, {0.0, 10.0});
  visitor.number({"reverse_speed", "m/s", "faster than this nothing moves backwards"},
                 reverse_speed, {0.0, 100.0});
}

TrackedBox::TrackedBox(const Object& object)
    : heading_(object.box.centre.heading()),
      heading_variance_(object.heading_variance),
      size_(object.box.length, object.box.width) {}

void TrackedBox::predict(double seconds, const TrackedBoxOptions& options) {
  heading_variance_ =
      std::min(kUnknownHeadingVariance, heading_variance_ + options.heading_drift * seconds);
}

void TrackedBox::update(const Object& object, double seconds, const TrackedBoxOptions& options) {
  updateHeading(sideAlong(object, heading_), object.heading_variance);
  const Eigen::Vector2d measured = sizeOf(object);
  for (int side = 0; side < 2; ++side) {
    const bool larger = measured[side] > size_[side];
    size_[side] += (measured[side] - size_[side]) *
                   share(seconds, larger ? options.growth_time : options.shrink_time);
  }
}

void TrackedBox::followVelocity(const Eigen::Vector2d& velocity, const Eigen::Matrix2d& covariance,
                                const TrackedBoxOptions& options) {
  const double speed = velocity.norm();
  const double direction = std::atan2(velocity.y(), velocity.x());
  if (!sign_known_ && isAcross(heading_, direction)) {
    heading_ = normalizeAngle(heading_ + 0.5 * kPi);
    std::swap(size_.x(), size_.y());
  }
  if (!sign_known_ || speed > options.reverse_speed) {
    heading_ = nearerDirection(heading_, direction);
    sign_known_ = true;
  }
  const Eigen::Vector2d across(-velocity.y() / speed, velocity.x() / speed);
  const double variance = across.dot(covariance * across) / (speed * speed);
  updateHeading(nearerDirection(direction, heading_), variance);
}

PositionMeasurement TrackedBox::measurementOf(const Object& object) const {
  const Eigen::Vector2d hidden = (size_ - sizeOf(object)).cwiseMax(0.0);
  const Eigen::Matrix2d axes = Pose2(Point2::Zero(), heading_).rotation();
  // What is hidden may lie on either side, anywhere.
  const Eigen::Vector2d variance = kUniformVariance * hidden.cwiseAbs2();
  return {object.box.centre.position(),
          object.position_covariance + axes * variance.asDiagonal() * axes.transpose()};
}

Box2 TrackedBox::at(const Point2& centre) const {
  return {Pose2(centre, heading_), size_.x(), size_.y()};
}

void TrackedBox::updateHeading(double measured, double variance) {
  const double total = heading_variance_ + variance;
  if (total <= 0.0) {
    return;
  }
  const double gain = heading_variance_ / total;
  heading_ = normalizeAngle(heading_ + gain * angleBetween(heading_, measured));
  heading_variance_ *= 1.0 - gain;
}

/// Along the axis of this box that is nearest to the object's, so that no side grows by a turn
/// alone.
Eigen::Vector2d TrackedBox::sizeOf(const Object& object) const {
  return isAcross(object.box.centre.heading(), heading_)
             ? Eigen::Vector2d(object.box.width, object.box.length)
             : Eigen::Vector2d(object.box.length, object.box.width);
}

}  // namespace datmo
