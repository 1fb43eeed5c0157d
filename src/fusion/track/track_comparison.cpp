// SPDX-License-Identifier: BSD-3-Clause
#include "datmo_fusion/fusion/track/track_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include <Eigen/Cholesky>

#include "datmo_fusion/common/angle.h"
#include "datmo_fusion/common/square.h"

namespace datmo {

namespace {

/// Standard deviation of each velocity component of unrelated objects, m/s.
constexpr double kUnrelatedSpeed = 8.0;

/// Only position and velocity distinguish two objects; accelerations are too uncertain.
constexpr int kCompared = 4;
using Compared = Eigen::Matrix<double, kCompared, 1>;
using ComparedCovariance = Eigen::Matrix<double, kCompared, kCompared>;

/// No class is impossible (ClassBelief): minimum ratio of "same class" to chance.
constexpr double kMinClassRatio = 0.05;

/// Pairs beyond this multiple of the gate are skipped: the fast path for most pairs.
constexpr double kFarBeyond = 2.0;

const double kLogOfTurn = std::log(2.0 * kPi);

/// m^2, along the axes of the box: variance of a sensor's estimate of the center of a partly
/// visible body.
Eigen::Vector2d centerVariances(const Track& track, const TrackComparisonOptions& options) {
  // The covariance of a track fused from several sensors already includes that of the body.
  const double body = track.sources.size() > 1 ? 0.0 : square(options.body_std);
  return {body + square(options.extent_share * track.box.length),
          body + square(options.extent_share * track.box.width)};
}

/// The same in the fixed frame.
Eigen::Matrix2d centerCovariance(const Track& track, const TrackComparisonOptions& options) {
  const Eigen::Matrix2d axes = track.box.center.rotation();
  return axes * centerVariances(track, options).asDiagonal() * axes.transpose();
}

/// m^2, total variance of a track's position.
double positionVariance(const Track& track, const TrackComparisonOptions& options) {
  return track.covariance.topLeftCorner<2, 2>().trace() + centerVariances(track, options).sum();
}

/// Log-likelihood ratio of the two tracks' classes for one object against two, with a uniform
/// prior. All 0: unknown.
double logClassRatio(const ClassProbabilities& a, const ClassProbabilities& b) {
  const double all =
      std::accumulate(a.begin(), a.end(), 0.0) * std::accumulate(b.begin(), b.end(), 0.0);
  if (all <= 0.0) {
    return 0.0;
  }
  const double same = std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  return std::log(std::max(kMinClassRatio, same / all * static_cast<double>(kObjectClasses)));
}

/// Log density of unrelated tracks in position and velocity, 1/(m^4/s^2).
double logUnrelatedDensity(const Eigen::Vector2d& velocity, const TrackComparisonOptions& options) {
  const double variance = square(kUnrelatedSpeed);
  return std::log(options.unrelated_density) - std::log(2.0 * kPi * variance) -
         0.5 * velocity.squaredNorm() / variance;
}

struct PoseDifference {
  double heading = 0.0;
  double x = 0.0;
  double y = 0.0;
};

PoseDifference magnitudes(const Pose2& a, const Pose2& b) {
  return {std::abs(angleBetween(a.heading(), b.heading())), std::abs(a.x() - b.x()),
          std::abs(a.y() - b.y())};
}

/// Interpolates between two points of a path.
Pose2 interpolated(const PathPoint& before, const PathPoint& after, Stamp stamp) {
  const double whole = secondsBetween(before.stamp, after.stamp);
  const double share = whole > 0.0 ? secondsBetween(before.stamp, stamp) / whole : 1.0;
  const double turn = angleBetween(before.pose.heading(), after.pose.heading());
  return {before.pose.position() + share * (after.pose.position() - before.pose.position()),
          before.pose.heading() + share * turn};
}

}  // namespace

void TrackComparisonOptions::visit(OptionVisitor& visitor) {
  visitor.number({"gate", "1",
                  "two tracks may become one within this Mahalanobis distance squared of position "
                  "and velocity: 18.5 is the 99.9 % quantile of chi-square with four degrees of "
                  "freedom"},
                 gate, {0.0, 1000.0});
  visitor.number(
      {"body_std", "m",
       "standard deviation of where a sensor locates a body's center: no road user is a box"},
      body_std, {0.0, 5.0});
  visitor.number({"extent_share", "1",
                  "the same along each axis of the box, in addition, as a share of its size: "
                  "sensors see different parts of it"},
                 extent_share, {0.0, 1.0});
  visitor.number({"velocity_std", "m/s",
                  "standard deviation between the velocities that two trackers estimate for one "
                  "object, beyond their covariances: the visible parts slide along it"},
                 velocity_std, {0.0, 10.0});
  visitor.number(
      {"unrelated_density", "1/m^2", "density of tracks of other objects, where there are many"},
      unrelated_density, {1e-6, 1.0});
}

TrackComparison compare(const Track& a, const Track& b, const TrackComparisonOptions& options) {
  const Compared difference = a.state.head<kCompared>() - b.state.head<kCompared>();
  const double variance = positionVariance(a, options) + positionVariance(b, options);
  if (difference.head<2>().squaredNorm() > kFarBeyond * options.gate * variance) {
    const double infinity = std::numeric_limits<double>::infinity();
    return {infinity, -infinity};
  }
  ComparedCovariance covariance = a.covariance.topLeftCorner<kCompared, kCompared>() +
                                  b.covariance.topLeftCorner<kCompared, kCompared>();
  covariance.topLeftCorner<2, 2>() += centerCovariance(a, options) + centerCovariance(b, options);
  covariance.bottomRightCorner<2, 2>().diagonal().array() += square(options.velocity_std);
  const Eigen::LLT<ComparedCovariance> root(covariance);
  const double squared_distance = root.matrixL().solve(difference).squaredNorm();
  const double log_determinant = 2.0 * root.matrixLLT().diagonal().array().log().sum();
  const double log_likelihood =
      -0.5 * (squared_distance + log_determinant + kCompared * kLogOfTurn);
  const Eigen::Vector2d velocity = 0.5 * (a.state.segment<2>(2) + b.state.segment<2>(2));
  return {squared_distance, log_likelihood - logUnrelatedDensity(velocity, options) +
                                logClassRatio(a.class_probabilities, b.class_probabilities)};
}

void ParallelTracksOptions::visit(OptionVisitor& visitor) {
  visitor.number({"heading", "rad", "largest mean difference of the headings of parallel tracks"},
                 heading, {0.0, kPi});
  visitor.number({"distance", "m", "largest mean difference of their x, and of their y"}, distance,
                 {0.0, 50.0});
}

bool areParallel(const Track& a, const Track& b, const ParallelTracksOptions& options) {
  PoseDifference sum;
  std::size_t points = 0;
  const auto add = [&](const Pose2& one, const Pose2& other) {
    const PoseDifference difference = magnitudes(one, other);
    sum.heading += difference.heading;
    sum.x += difference.x;
    sum.y += difference.y;
    ++points;
  };
  add(a.box.center, b.box.center);
  for (const PathPoint& point : a.history) {
    const auto after =
        std::lower_bound(b.history.begin(), b.history.end(), point.stamp,
                         [](const PathPoint& other, Stamp stamp) { return other.stamp < stamp; });
    if (after != b.history.end() && (after != b.history.begin() || after->stamp == point.stamp)) {
      const auto before = after == b.history.begin() ? after : after - 1;
      add(point.pose, interpolated(*before, *after, point.stamp));
    }
  }
  const auto mean = [points](double total) { return total / static_cast<double>(points); };
  return mean(sum.heading) < options.heading && mean(sum.x) < options.distance &&
         mean(sum.y) < options.distance;
}

}  // namespace datmo
