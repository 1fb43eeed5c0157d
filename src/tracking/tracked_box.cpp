// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/tracking/tracked_box.h"

#include <algorithm>
#include <cmath>

#include "datmo_fusion/common/perpendicular.h"

namespace datmo {

namespace {

/// Limit of the log odds from one velocity: those of successive scans are nearly the same
/// information.
constexpr double kMaxOddsOfOneVelocity = 2.0;

/// Share of the step, per scan, from the sides on which the filter's center is based to those seen
/// now: the filter trusts the new ones little while the size between them is uncertain.
constexpr double kHandover = 0.3;

/// Minimum probability of the other axis to become the forward one: avoids toggling.
constexpr double kSureOfOtherAxis = 0.7;

/// The one of the two directions of a line that is nearer to `reference`.
double nearerDirection(double direction, double reference) {
  return std::cos(direction - reference) < 0.0 ? normalizeAngle(direction + kPi) : direction;
}

/// Quarter turns to the left, 0 to 3, that bring one direction closest to another.
int quartersBetween(double from, double to) {
  return (static_cast<int>(std::lround(angleBetween(from, to) / kQuarterTurn)) + 4) % 4;
}

/// An object's sides along one axis of the box.
struct SeenAxis {
  double extent;  ///< m
  double ahead;   ///< m^2, variance of the side at the positive end
  double behind;  ///< m^2, of the one at the negative end
  bool isSeenAhead() const { return std::isfinite(ahead); }
  bool isSeenBehind() const { return std::isfinite(behind); }

  /// `position_variance`, m^2: of the object along the axis, which is also the uncertainty of the
  /// visible limit toward a hidden end.
  VisibleExtent visible(double position_variance) const {
    return {extent, (isSeenAhead() ? ahead : 0.0) + (isSeenBehind() ? behind : 0.0),
            isSeenAhead() && isSeenBehind(), std::sqrt(position_variance)};
  }
};

/// An object along the axes of the box that are nearest to its own.
struct SeenBox {
  double heading;  ///< rad, of the object's axis that is nearest to the box's heading
  std::array<SeenAxis, 2> axes;
};

SeenBox seenFrom(double heading, const Object& object) {
  constexpr std::array<BoxSide, kBoxSides> kToTheLeft = {BoxSide::kFront, BoxSide::kLeft,
                                                         BoxSide::kRear, BoxSide::kRight};
  const Box2& box = object.box;
  const auto turn = static_cast<std::size_t>(quartersBetween(box.center.heading(), heading));
  const auto variance = [&](std::size_t quarter) {
    const BoxSide side = kToTheLeft[(turn + quarter) % kBoxSides];
    return object.side_variance[static_cast<std::size_t>(side)];
  };
  const bool across = turn % 2 == 1;
  return {normalizeAngle(box.center.heading() + static_cast<double>(turn) * kQuarterTurn),
          {SeenAxis{across ? box.width : box.length, variance(0), variance(2)},
           SeenAxis{across ? box.length : box.width, variance(1), variance(3)}}};
}

/// The best estimate of the center along one axis is `middle of the visible sides + share * (size -
/// extent)`.
struct AxisMeasurement {
  double share;     ///< -0.5 to 0.5
  double variance;  ///< m^2, of the part that is independent from scan to scan
};

/// Least squares over both sides and the current size, whose error moves the center away from
/// either side: C = [a + P/4, -P/4; -P/4, b + P/4].
AxisMeasurement measured(const SeenAxis& seen, double size, double size_variance,
                         double last_share) {
  if (!seen.isSeenAhead() && !seen.isSeenBehind()) {
    const double hidden = std::max(0.0, size - seen.extent);
    return {last_share, kUniformVariance * (hidden * hidden + size_variance)};
  }
  if (!seen.isSeenBehind()) {
    return {-0.5, seen.ahead};
  }
  if (!seen.isSeenAhead()) {
    return {0.5, seen.behind};
  }
  const double total = seen.ahead + seen.behind + size_variance;
  const double share = total > 0.0 ? 0.5 * (seen.ahead - seen.behind) / total : 0.0;
  const double weight_ahead = 0.5 - share;
  const double weight_behind = 0.5 + share;
  return {share,
          weight_ahead * weight_ahead * seen.ahead + weight_behind * weight_behind * seen.behind};
}

Eigen::Vector2d sharesOf(const SeenBox& seen, const BoxSize& size, const Eigen::Vector2d& last) {
  return {measured(seen.axes[0], size.mean().x(), size.variance().x(), last.x()).share,
          measured(seen.axes[1], size.mean().y(), size.variance().y(), last.y()).share};
}

/// The axes of a box with this heading, as columns.
Eigen::Matrix2d axesOf(double heading) { return Pose2(Point2::Zero(), heading).rotation(); }

Eigen::Matrix2d alongAxes(const Eigen::Matrix2d& axes, const Eigen::Vector2d& variance) {
  return axes * variance.asDiagonal() * axes.transpose();
}

}  // namespace

void TrackedBoxOptions::visit(OptionVisitor& visitor) {
  visitor.group("size", [&] { size.visit(visitor); });
  visitor.number(
      {"heading_drift", "rad^2/s", "growth of the heading's variance while the object is not seen"},
      heading_drift, {0.0, 10.0});
  visitor.number({"reverse_speed", "m/s", "nothing moves backward faster than this"}, reverse_speed,
                 {0.0, 100.0});
}

TrackedBox::TrackedBox(const Object& object, const TrackedBoxOptions& options)
    : heading_(object.box.center.heading()),
      axes_(axesOf(heading_)),
      heading_variance_(kUnknownHeadingVariance),
      size_(options.size) {
  anchor_share_ = sharesOf(seenFrom(heading_, object), size_, anchor_share_);
  update(object, 0.0, options);
}

void TrackedBox::predict(double seconds, const TrackedBoxOptions& options) {
  since_velocity_ += seconds;
  heading_variance_ =
      std::min(kUnknownHeadingVariance, heading_variance_ + options.heading_drift * seconds);
}

PositionMeasurement TrackedBox::measurementOf(const Object& object) const {
  const SeenBox seen = seenFrom(heading_, object);
  const Eigen::Matrix2d seen_axes = axesOf(seen.heading);
  Eigen::Vector2d share;
  Eigen::Vector2d extent;
  Eigen::Vector2d variance;
  for (int axis = 0; axis < 2; ++axis) {
    const SeenAxis& sides = seen.axes[static_cast<std::size_t>(axis)];
    const double size_variance = size_.variance()[axis];
    const AxisMeasurement along =
        measured(sides, size_.mean()[axis], size_variance, anchor_share_[axis]);
    const double change = along.share - anchor_share_[axis];
    share[axis] = along.share;
    extent[axis] = sides.extent;
    variance[axis] = along.variance + change * change * size_variance;
  }
  return {object.box.center.position() - seen_axes * share.cwiseProduct(extent) +
              axes_ * share.cwiseProduct(size_.mean()),
          object.position_covariance + alongAxes(seen_axes, variance), object.delay};
}

CenterGate TrackedBox::gateOf(const StateEstimate& estimate, double gate) const {
  return {gate,
          std::sqrt(maxVariance(estimate.covariance.topLeftCorner<2, 2>())),
          estimate.mean.segment<2>(2).norm(),
          std::sqrt(maxVariance(estimate.covariance.block<2, 2>(2, 2))),
          size_.mean().norm(),
          anchor_share_.cwiseAbs().maxCoeff(),
          size_.variance().maxCoeff()};
}

Point2 TrackedBox::update(const Object& object, double seconds, const TrackedBoxOptions& options) {
  const SeenBox seen = seenFrom(heading_, object);
  const Eigen::Vector2d share = sharesOf(seen, size_, anchor_share_);
  const Point2 before = offset();
  const ObjectClass object_class = object.objectClass();
  size_.classify(object_class, probabilityOf(object_class, object.class_probabilities));
  // The apparent width of a rotated box is partly its length.
  const double slant_variance = std::min(object.heading_variance, kUnknownAxisVariance);
  const Eigen::Matrix2d axes = axesOf(seen.heading);
  const Eigen::Matrix2d in_axes = axes.transpose() * object.position_covariance * axes;
  const Eigen::Vector2d position_variance = in_axes.diagonal().cwiseMax(0.0);
  std::array<VisibleExtent, 2> visible = {seen.axes[0].visible(position_variance.x()),
                                          seen.axes[1].visible(position_variance.y())};
  visible[0].variance += slant_variance * size_.mean().y() * size_.mean().y();
  visible[1].variance += slant_variance * size_.mean().x() * size_.mean().x();
  size_.update(visible, seconds, options.size);
  if (object.heading_variance < kUnknownAxisVariance) {
    updateHeading(seen.heading, object.heading_variance);
  }
  Point2 moved = offset() - before;
  anchor_share_ += kHandover * (share - anchor_share_);
  if (!sign_known_ && size_.probabilityAlongFirst() < 1.0 - kSureOfOtherAxis) {
    turnByQuarters(1);
  }
  return moved;
}

Point2 TrackedBox::followVelocity(const Eigen::Vector2d& velocity,
                                  const Eigen::Matrix2d& covariance,
                                  const TrackedBoxOptions& options) {
  const double speed = velocity.norm();
  if (speed <= 0.0) {
    return Point2::Zero();
  }
  const Point2 before = offset();
  const double direction = std::atan2(velocity.y(), velocity.x());
  const Eigen::Vector2d across(-velocity.y() / speed, velocity.x() / speed);
  const double variance =
      across.dot(covariance * across) / (speed * speed) + options.slip_std * options.slip_std;
  // Objects move along their length: how much farther is the velocity from the other axis?
  const double apart = std::abs(angleBetween(heading_, nearerDirection(direction, heading_)));
  const double odds = 0.5 * kQuarterTurn * (kQuarterTurn - 2.0 * apart) /
                      (variance + std::min(heading_variance_, kUnknownAxisVariance));
  size_.addOddsAlongFirst(std::clamp(odds, -kMaxOddsOfOneVelocity, kMaxOddsOfOneVelocity));
  if (size_.probabilityAlongFirst() < 1.0 - kSureOfOtherAxis) {
    turnByQuarters(1);
    sign_known_ = false;
    ahead_ = 0.0;
  }
  setFrontAhead(direction, speed, options);
  // Velocities of successive scans are not independent measurements of the heading: keep the best.
  if (variance < heading_variance_) {
    setHeading(nearerDirection(direction, heading_));
    heading_variance_ = variance;
  }
  return offset() - before;
}

Eigen::Matrix2d TrackedBox::centerCovariance() const {
  const Eigen::Vector2d lever = axes_ * anchor_share_.cwiseProduct(size_.mean());
  const Eigen::Vector2d swing = perpendicular(lever);
  const double turn_variance = std::min(heading_variance_, kUnknownAxisVariance);
  return alongAxes(axes_, anchor_share_.cwiseAbs2().cwiseProduct(size_.variance())) +
         turn_variance * swing * swing.transpose();
}

Box2 TrackedBox::at(const Point2& center) const {
  return {Pose2(center, heading_), size_.mean().x(), size_.mean().y()};
}

double TrackedBox::headingVariance() const {
  const double other_axis = 1.0 - size_.probabilityAlongFirst();
  return std::min(kUnknownHeadingVariance,
                  heading_variance_ + other_axis * kQuarterTurn * kQuarterTurn);
}

/// From the visible sides to the center, m, fixed frame.
Eigen::Vector2d TrackedBox::offset() const {
  return axes_ * anchor_share_.cwiseProduct(size_.mean());
}

/// The first motion is forward, and so is fast motion; otherwise it may be reversing.
void TrackedBox::setFrontAhead(double direction, double speed, const TrackedBoxOptions& options) {
  const bool backward = std::cos(direction - heading_) < 0.0;
  ahead_ += backward ? -since_velocity_ : since_velocity_;
  if (backward && (!sign_known_ || speed > options.reverse_speed || ahead_ < 0.0)) {
    turnByQuarters(2);
    ahead_ = 0.0;
  }
  ahead_ = std::min(ahead_, options.reverse_time);
  since_velocity_ = 0.0;
  sign_known_ = true;
}

/// Makes another side the front; the box itself does not move.
void TrackedBox::turnByQuarters(int quarters) {
  setHeading(normalizeAngle(heading_ + quarters * kQuarterTurn));
  for (int i = 0; i < quarters; ++i) {
    anchor_share_ = Eigen::Vector2d(anchor_share_.y(), -anchor_share_.x());
    size_.swapAxes();
  }
}

void TrackedBox::setHeading(double heading) {
  heading_ = heading;
  axes_ = axesOf(heading);
}

void TrackedBox::updateHeading(double measured, double variance) {
  const double total = heading_variance_ + variance;
  if (total <= 0.0) {
    return;
  }
  const double gain = heading_variance_ / total;
  setHeading(normalizeAngle(heading_ + gain * angleBetween(heading_, measured)));
  heading_variance_ *= 1.0 - gain;
}

}  // namespace datmo
