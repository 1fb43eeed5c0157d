// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/object/object_combination.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "fused_sides.h"
#include "object_sides.h"
#include <Eigen/LU>

#include "datmo_fusion/common/class_belief.h"
#include "datmo_fusion/common/object_turn.h"

namespace datmo {

namespace {

/// Number of standard deviations at which a difference is significant.
constexpr double kClearly = 4.0;

/// m^2, minimum position variance of a result.
constexpr double kMinVariance = 1e-8;

/// Maximum correlation of a result: its covariance must be positive definite.
constexpr double kMaxCorrelation = 0.999;

double fusedVariance(double a, double b) { return a * b / (a + b); }

/// Certain extent of the object along an axis, m: the maximum of both, the less certain one reduced
/// by its excess uncertainty.
double sureExtent(const ObjectSides& a, const ObjectSides& b, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  const double less_sure = std::sqrt(a.covariance(i, i)) - std::sqrt(b.covariance(i, i));
  return std::max(a.along[axis].extent() - std::max(0.0, less_sure),
                  b.along[axis].extent() - std::max(0.0, -less_sure));
}

/// The sides across one axis in the result, and their common variance, m^2.
struct FusedAxis {
  SidePair sides;
  double common_variance = 0.0;
};

/// Discards an end that one source saw if the other saw the object extend significantly beyond it:
/// a beam that ends on a long side carries no information on its ends.
void dropContradicted(ObjectSides& sides, const ObjectSides& other) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    const double of_whole = sides.covariance(i, i) + other.covariance(i, i);
    for (std::size_t end = 0; end < 2; ++end) {
      SidePair& own = sides.along[axis];
      const SidePair& seen = other.along[axis];
      const double beyond = (end == 0 ? -1.0 : 1.0) * (seen.position[end] - own.position[end]);
      const double sigma = std::sqrt(of_whole + own.variance[end]);
      if (own.isSeen(end) && !seen.isSeen(end) && beyond > kClearly * sigma) {
        own.variance[end] = kHiddenSide;
      }
    }
  }
}

/// Extent from both sources if neither saw the ends across one axis. Two views of the same part are
/// fused; with different parts, the object extends as far as either saw it, the less certain one
/// reduced by its excess uncertainty.
FusedAxis jointExtent(const ObjectSides& a, const ObjectSides& b, std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  const double of_a = a.covariance(i, i);
  const double of_b = b.covariance(i, i);
  const SidePair& seen_a = a.along[axis];
  const SidePair& seen_b = b.along[axis];
  FusedAxis result;
  if (std::abs(seen_a.extent() - seen_b.extent()) <= std::sqrt(of_a + of_b)) {
    const double share_of_b = of_a / (of_a + of_b);
    const double middle = (1.0 - share_of_b) * seen_a.middle() + share_of_b * seen_b.middle();
    const double half = 0.5 * sureExtent(a, b, axis);
    result.sides.position = {middle - half, middle + half};
    result.common_variance = fusedVariance(of_a, of_b);
  } else {
    const double less_sure = 0.5 * (std::sqrt(of_a) - std::sqrt(of_b));
    const double off_a = std::min(std::max(0.0, less_sure), 0.5 * seen_a.extent());
    const double off_b = std::min(std::max(0.0, -less_sure), 0.5 * seen_b.extent());
    result.sides.position = {std::min(seen_a.position[0] + off_a, seen_b.position[0] + off_b),
                             std::max(seen_a.position[1] - off_a, seen_b.position[1] - off_b)};
    result.common_variance = std::max(of_a, of_b);
  }
  result.common_variance = std::max(result.common_variance, kMinVariance);
  return result;
}

FusedAxis fusedAxis(const FusedSides& fused, const ObjectSides& a, const ObjectSides& b,
                    std::size_t axis) {
  const auto i = static_cast<Eigen::Index>(axis);
  const Eigen::Index behind = 2 * i;
  const Eigen::Index ahead = behind + 1;
  const double of_whole = fusedVariance(a.covariance(i, i), b.covariance(i, i));
  const bool sees_behind = fused.seen[2 * axis];
  const bool sees_ahead = fused.seen[2 * axis + 1];
  const double extent = sureExtent(a, b, axis);
  FusedAxis result;
  result.sides.variance = {kHiddenSide, kHiddenSide};
  if (sees_behind && sees_ahead) {
    const double min = std::min(fused.covariance(behind, behind), fused.covariance(ahead, ahead));
    // Too much common variance makes the center less certain, never more.
    result.common_variance =
        std::max({fused.covariance(behind, ahead), std::min(of_whole, min), kMinVariance});
    const double middle = 0.5 * (fused.position[behind] + fused.position[ahead]);
    result.sides.position = {std::min(fused.position[behind], middle),
                             std::max(fused.position[ahead], middle)};
    for (std::size_t end = 0; end < 2; ++end) {
      const Eigen::Index side = behind + static_cast<Eigen::Index>(end);
      result.sides.variance[end] =
          std::max(0.0, fused.covariance(side, side) - result.common_variance);
    }
  } else if (sees_behind || sees_ahead) {
    const Eigen::Index side = sees_ahead ? ahead : behind;
    const double position = fused.position[side];
    result.common_variance = std::max(fused.covariance(side, side), kMinVariance);
    result.sides.variance[sees_ahead ? 1 : 0] = 0.0;
    result.sides.position = {sees_ahead ? position - extent : position,
                             sees_ahead ? position : position + extent};
  } else {
    const FusedAxis joint = jointExtent(a, b, axis);
    result.sides.position = joint.sides.position;
    result.common_variance = joint.common_variance;
  }
  return result;
}

/// m^2, of x and y of the box as a whole: the covariance common to all seen sides; more would make
/// some corner too certain.
double commonCovariance(const FusedSides& fused, const std::array<FusedAxis, 2>& axes) {
  double min = kMaxCorrelation * std::sqrt(axes[0].common_variance * axes[1].common_variance);
  double sign = 0.0;
  for (Eigen::Index x = 0; x < 2; ++x) {
    for (Eigen::Index y = 2; y < 4; ++y) {
      if (fused.seen[static_cast<std::size_t>(x)] && fused.seen[static_cast<std::size_t>(y)]) {
        const double value = fused.covariance(x, y);
        min = sign * value < 0.0 ? 0.0 : std::min(min, std::abs(value));
        sign = value < 0.0 ? -1.0 : 1.0;
      }
    }
  }
  return sign * min;
}

/// Combines box, position and the variances of its sides; returns the share of `b` in them.
double combineGeometry(const Object& a, const Object& b, Object& result) {
  const CommonHeading heading = commonHeading(a, b);
  const CommonAxes axes(a, b, heading);
  ObjectSides sides_a = sidesIn(axes, a);
  ObjectSides sides_b = sidesIn(axes, b);
  const ObjectSides as_seen_by_a = sides_a;
  dropContradicted(sides_a, sides_b);
  dropContradicted(sides_b, as_seen_by_a);
  const FusedSides sides = fusedSides(sides_a, sides_b);
  const std::array<FusedAxis, 2> along = {fusedAxis(sides, sides_a, sides_b, 0),
                                          fusedAxis(sides, sides_a, sides_b, 1)};
  const Point2 middle(along[0].sides.middle(), along[1].sides.middle());
  result.box = {Pose2(axes.pose * middle, axes.pose.heading()), along[0].sides.extent(),
                along[1].sides.extent()};
  result.side_variance = {along[0].sides.variance[1], along[0].sides.variance[0],
                          along[1].sides.variance[1], along[1].sides.variance[0]};
  const double mixed = commonCovariance(sides, along);
  Eigen::Matrix2d covariance;
  covariance << along[0].common_variance, mixed, mixed, along[1].common_variance;
  const Eigen::Matrix2d turned = axes.rotation * covariance * axes.rotation.transpose();
  result.position_covariance = 0.5 * (turned + turned.transpose());
  result.heading_variance = heading.variance;
  if (!heading.same_axis && result.box.width > result.box.length) {
    turnByQuarter(result);
  }
  return sides.weight_of_b;
}

DynamicState combinedState(DynamicState a, DynamicState b) {
  for (const DynamicState state : {DynamicState::kMoving, DynamicState::kStatic}) {
    if (a == state || b == state) {
      return state;
    }
  }
  return DynamicState::kUnknown;
}

/// Mean of two independent measurements, weighted by information.
std::optional<MeasuredVelocity> combinedVelocity(const std::optional<MeasuredVelocity>& a,
                                                 const std::optional<MeasuredVelocity>& b) {
  if (!a || !b) {
    return a ? a : b;
  }
  const Eigen::Matrix2d weight_of_b = a->covariance * (a->covariance + b->covariance).inverse();
  const Eigen::Matrix2d covariance = weight_of_b * b->covariance;
  return MeasuredVelocity{a->velocity + weight_of_b * (b->velocity - a->velocity),
                          0.5 * (covariance + covariance.transpose()),
                          std::max(a->wrong_probability, b->wrong_probability)};
}

/// A camera's scattered points are not points at which a beam ended, and a single echo among them
/// is not a surface.
const std::vector<Point2>& surestPoints(const Object& a, const Object& b) {
  if (a.points.empty() || b.points.empty()) {
    return a.points.empty() ? b.points : a.points;
  }
  return a.position_covariance.trace() <= b.position_covariance.trace() ? a.points : b.points;
}

/// Prior information from the road counts once, however many sensors see an object there.
double combinedPrior(double a, double b) { return std::abs(a) >= std::abs(b) ? a : b; }

/// If one of them does not indicate a class, those of the other; else Bayes.
ClassProbabilities combinedClass(const ClassProbabilities& a, const ClassProbabilities& b) {
  const std::optional<ClassProbabilities> of_a = classLikelihoods(a);
  const std::optional<ClassProbabilities> of_b = classLikelihoods(b);
  if (of_a && of_b) {
    return jointBelief({*of_a, *of_b});
  }
  return of_a ? a : of_b ? b : ClassProbabilities{};
}

}  // namespace

Object combined(const Object& a, const Object& b) {
  Object result;
  const double share_of_b = combineGeometry(a, b, result);
  result.class_probabilities = combinedClass(a.class_probabilities, b.class_probabilities);
  result.delay = (1.0 - share_of_b) * a.delay + share_of_b * b.delay;
  // A partly visible object looks lower than it is.
  result.height = std::max(a.height, b.height);
  result.dynamic_state = combinedState(a.dynamic_state, b.dynamic_state);
  result.velocity = combinedVelocity(a.velocity, b.velocity);
  result.moving_fraction = std::max(a.moving_fraction, b.moving_fraction);
  result.log_odds = a.log_odds + b.log_odds;
  result.motion_log_odds = combinedPrior(a.motion_log_odds, b.motion_log_odds);
  result.sensors = a.sensors;
  result.sensors.insert(result.sensors.end(), b.sensors.begin(), b.sensors.end());
  std::sort(result.sensors.begin(), result.sensors.end());
  result.sensors.erase(std::unique(result.sensors.begin(), result.sensors.end()),
                       result.sensors.end());
  result.points = surestPoints(a, b);
  return result;
}

}  // namespace datmo
